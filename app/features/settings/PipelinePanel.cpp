#include "app/features/settings/PipelinePanel.h"

#include "analyse/chooseWindow.h"
#include "app/base/writeAndReport.h"
#include "app/document/AnalysisController.h"
#include "app/features/settings/OwnPresets.h"
#include "noise/NoiseNormaliser.h"
#include "noise/pings/NormalisedPings.h"
#include "plan/firstSettings.h"
#include "plan/slopeUnit.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/SettingsForm.h"

#include <QComboBox>
#include <QFormLayout>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    /// "WAV, int16 · 12 kHz · 15 s"
    QString summary(const RecordingInfo &info)
    {
        QStringList parts{
            labelText(info.container == info.sampleType ? info.container : info.container + ", " + info.sampleType)};
        parts << hertzText(info.sampleRateHz, 1e-3 * info.sampleRateHz)
              << secondsText(info.durationSeconds(), 1e-2 * info.durationSeconds());
        if (info.channelCount > 1)
            parts << QObject::tr("%1 channels").arg(info.channelCount);
        return parts.join(QStringLiteral(" · "));
    }

    /// "60 pings, every 40 s · 2500 range × 20 bearing"
    QString summary(const NormalisedFrames &frames)
    {
        QStringList axes;
        for (const Axis &axis : frames.grid().axes)
            axes << (axis.isNamed ? QStringLiteral("%1 %2").arg(axis.count).arg(labelText(axis.name, mostUnitLetters))
                                  : QString::number(axis.count));
        const QString words = QObject::tr("%1 %2, every %3 s · %4")
                                  .arg(frames.time().count)
                                  .arg(frameKindOf(frames.grid()).frames)
                                  .arg(frames.time().step, 0, 'g', 4)
                                  .arg(axes.join(QStringLiteral(" × ")));
        const std::string assumption = pingAssumption(frames);
        return assumption.empty() ? words : words + QStringLiteral(" · ") + labelText(assumption, longestPath);
    }

} // namespace

PipelinePanel::PipelinePanel(Document &document, AnalysisController &controller, OwnPresets &ownPresets,
                             QWidget *parent)
    : Panel(parent), m_document(document), m_controller(controller), m_ownPresets(ownPresets), m_recording(new QLabel),
      m_preset(new QComboBox), m_window(new QComboBox), m_top(new QFormLayout), m_form(new SettingsForm)
{
    m_recording->setWordWrap(true);
    m_recording->setTextFormat(Qt::RichText);
    listPresets();
    m_preset->setAccessibleName(tr("Preset"));
    m_preset->setToolTip(tr("Initial settings for a kind of recording; Edit > Save settings as preset adds your own"));

    m_window->setObjectName(QStringLiteral("windowChoice"));
    m_window->setAccessibleName(tr("Window"));
    m_window->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_window->setMinimumContentsLength(18); // "From the recording: 200 s" is seen whole
    m_window->setToolTip(
        tr("Windows tried on this recording, with the number of tracks found with each, before the second "
           "pass joins, splits or drops some"));

    m_top->setContentsMargins(10, 5, 10, 3);
    m_top->setHorizontalSpacing(10);
    m_top->addRow(m_recording);
    m_top->addRow(tr("&Preset"), m_preset);
    m_top->addRow(tr("&Window"), m_window);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(m_top);
    layout->addWidget(m_form, 1);

    connect(m_preset, &QComboBox::activated, this, &PipelinePanel::applyPreset);
    connect(m_window, &QComboBox::activated, this, &PipelinePanel::applyWindow);
    connect(m_form, &SettingsForm::settingEdited, this, [this](const QString &name, const FieldValue &value) {
        m_controller.edit(name, value, tr("Change “%1”").arg(settingLabel(name)));
    });
    connect(m_form, &SettingsForm::resetRequested, this,
            [this] { m_controller.setSettings(firstSettings(m_document.openedSource()), tr("Reset all settings")); });
    connect(&ownPresets, &OwnPresets::changed, this, [this] {
        listPresets();
        showSettings();
    });
    connect(&document, &Document::opened, this, &PipelinePanel::showRecording);
    connect(&document, &Document::opened, this, [this] {
        m_choice.reset();
        showSettings();
    });
    connect(&document, &Document::settingsChanged, this, &PipelinePanel::showSettings);
    connect(&document, &Document::analysisChanged, this, &PipelinePanel::showRecording);
    connect(&document, &Document::analysisChanged, this, &PipelinePanel::showNotes);
    connect(&controller, &AnalysisController::failed, this, &PipelinePanel::showError);
    showRecording();
    showSettings();
}

void PipelinePanel::showRecording()
{
    if (m_document.isEmpty())
        return m_recording->setText(tr("Nothing is open."));
    const QString words = m_document.frames() ? summary(*m_document.frames()) : summary(m_document.recording()->info());
    m_recording->setText(
        QStringLiteral("<b>%1</b><br>%2").arg(m_document.sourceName().toHtmlEscaped(), words.toHtmlEscaped()));
}

void PipelinePanel::showSettings()
{
    m_form->setSettings(m_document.settings());
    m_form->setHzPerSecondOfABinAFrame(
        m_document.recording() ? hzPerSecondOfABinAFrame(m_document.settings(), m_document.recording()->info()) : 0.0);
    const bool hasSamples = m_document.isEmpty() || m_document.recording();
    for (const char *stage : {"spectrogram", "family", "subtract"})
        m_form->setSectionShown(QString::fromLatin1(stage), hasSamples);
    for (const char *stage : {"selection", "noise"})
        m_form->setSectionShown(QString::fromLatin1(stage), hasSamples || m_document.openedSource().isPower);
    m_form->setSectionShown(QStringLiteral("pings"), m_document.openedSource().isRecordedPings());
    for (const FrameKind *kind : {&lineFrames(), &pingFrames()})
        for (const QString &section : kind->sections)
            m_form->setSectionShown(section, kind->isShownLike(m_document.frameKind()));
    int taken = 1;
    while (taken < m_preset->count() && forSource(presetAt(taken).settings) != m_document.settings())
        ++taken;
    m_preset->setCurrentIndex(taken < m_preset->count() ? taken : 0);
    showWindows();
}

/// The program's presets, then the user's.
void PipelinePanel::listPresets()
{
    m_preset->clear();
    m_preset->addItem(tr("Own settings"));
    for (const std::vector<Preset> *all : {&presets(), &m_ownPresets.all()})
        for (const Preset &preset : *all) {
            m_preset->addItem(QString::fromStdString(preset.name));
            m_preset->setItemData(m_preset->count() - 1,
                                  preset.sentence.empty() ? tr("Your own preset")
                                                          : QString::fromStdString(preset.sentence),
                                  Qt::ToolTipRole);
        }
}

const Preset &PipelinePanel::presetAt(int index) const
{
    const auto at = std::size_t(index - 1);
    return at < presets().size() ? presets()[at] : m_ownPresets.all()[at - presets().size()];
}

void PipelinePanel::savePreset()
{
    bool isGiven = false;
    const QString name =
        QInputDialog::getText(this, tr("Save settings as preset"), tr("Name:"), QLineEdit::Normal, {}, &isGiven);
    if (isGiven)
        actOrReport(*this, [&] { m_ownPresets.save(name.trimmed(), m_document.settings()); });
}

void PipelinePanel::removePreset()
{
    QStringList names;
    for (const Preset &preset : m_ownPresets.all())
        names << QString::fromStdString(preset.name);
    if (names.isEmpty())
        return emit failed(Error("presets", "there are none of your own; Edit > Save settings as preset makes one"));
    bool isGiven = false;
    const QString name = QInputDialog::getItem(this, tr("Delete preset"), tr("Preset:"), names, 0, false, &isGiven);
    if (isGiven)
        m_ownPresets.remove(name);
}

void PipelinePanel::showWindows()
{
    m_window->clear();
    if (m_choice && m_choice->trials.size() > 1) {
        const auto seconds = [&](std::size_t trial) {
            return QString::number(m_choice->trials[trial].windowSeconds, 'g', 4);
        };
        m_window->addItem(tr("From the recording: %1 s").arg(seconds(m_choice->chosen)));
        for (std::size_t i = 0; i < m_choice->trials.size(); ++i)
            m_window->addItem(
                tr("%1 s, %n track(s) in its trial", nullptr, int(m_choice->trials[i].tracks)).arg(seconds(i)));
        const auto taken =
            std::find_if(m_choice->trials.begin(), m_choice->trials.end(), [this](const WindowTrial &trial) {
                return inWindowOf(trial, m_document.settings()) == m_document.settings();
            });
        if (leavesWindowToRecording(m_document.analysedSettings()))
            m_window->setCurrentIndex(0);
        else
            m_window->setCurrentIndex(taken == m_choice->trials.end() ? -1 : int(taken - m_choice->trials.begin()) + 1);
    }
    m_window->setVisible(m_window->count() > 0);
    m_top->labelForField(m_window)->setVisible(m_window->count() > 0);
}

void PipelinePanel::showNotes()
{
    const Analysis &analysis = *m_document.analysis();
    m_form->clearErrors();
    if (analysis.choice)
        m_choice = analysis.choice;
    showWindows();
    if (const FrameGeometry geometry = analysis.frames->geometry(); geometry.isOfSpectra())
        m_form->setNote(QStringLiteral("spectrogram.windowSeconds"),
                        analysis.choice ? QString::fromStdString(windowChoiceWords(*analysis.choice))
                                        : tr("%1 s").arg(geometry.windowSeconds, 0, 'g', 4));
    const ModelSettings &used = analysis.settings.model;
    if (!analysis.choice || used == m_document.analysedSettings().model)
        return;
    m_form->setNote(QStringLiteral("model.lowestSlope"), tr("%1 bins/frame in this window").arg(used.lowestSlope));
    m_form->setNote(QStringLiteral("model.highestSlope"), tr("%1 bins/frame in this window").arg(used.highestSlope));
}

void PipelinePanel::showError(const Error &error)
{
    const QString name = QString::fromStdString(error.field());
    if (m_form->editor(name))
        m_form->setError(name, messageText(error.why()));
}

void PipelinePanel::applyPreset(int index)
{
    if (index == 0)
        return showSettings();
    m_controller.setSettings(forSource(presetAt(index).settings),
                             tr("Apply preset “%1”").arg(m_preset->itemText(index)));
}

void PipelinePanel::applyWindow(int index)
{
    const WindowTrial &trial = m_choice->trials[index == 0 ? m_choice->automatic : std::size_t(index - 1)];
    AnalysisSettings settings = inWindowOf(trial, m_document.settings());
    if (index == 0)
        settings.spectrogram.windowSeconds = 0.0;
    m_controller.setSettings(settings, tr("Apply window “%1”").arg(m_window->itemText(index)));
}

AnalysisSettings PipelinePanel::forSource(AnalysisSettings settings) const
{
    settings.selection = m_document.settings().selection;
    const RecordingPointer &recording = m_document.openedSource().recording;
    return recording ? withFittedOrder(std::move(settings), recording->info()) : settings;
}

} // namespace faintline
