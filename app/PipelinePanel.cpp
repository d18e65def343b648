#include "app/PipelinePanel.h"

#include "app/AnalysisController.h"
#include "analysis/slopeUnit.h"
#include "spectrum/NoiseNormaliser.h"
#include "widgets/SettingsForm.h"
#include "widgets/Theme.h"
#include "widgets/labelText.h"
#include "widgets/quantities.h"
#include "widgets/settingWords.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    /// "WAV, int16 · 12 kHz · 15 s"
    QString summary(const RecordingInfo &info)
    {
        QStringList parts{labelText(
            info.container == info.sampleType ? info.container : info.container + ", " + info.sampleType)};
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
            axes << QStringLiteral("%1 %2").arg(axis.count).arg(labelText(axis.name, mostUnitLetters));
        const QString kind = axes.size() > 1 ? QObject::tr("pings") : QObject::tr("frames");
        return QObject::tr("%1 %2, every %3 s · %4")
            .arg(frames.time().count)
            .arg(kind)
            .arg(frames.time().step, 0, 'g', 4)
            .arg(axes.join(QStringLiteral(" × ")));
    }

    double windowSeconds(const Spectrogram &spectrogram)
    {
        return spectrogram.windowSamples() / spectrogram.recording().info().sampleRateHz;
    }

} // namespace

PipelinePanel::PipelinePanel(Document &document, AnalysisController &controller, QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller), m_recording(new QLabel), m_preset(new QComboBox),
      m_form(new SettingsForm)
{
    m_recording->setWordWrap(true);
    m_recording->setTextFormat(Qt::RichText);
    m_preset->addItem(tr("Own settings"));
    for (const Preset &preset : presets()) {
        m_preset->addItem(QString::fromStdString(preset.name));
        m_preset->setItemData(m_preset->count() - 1, QString::fromStdString(preset.sentence), Qt::ToolTipRole);
    }
    m_preset->setAccessibleName(tr("Preset"));
    m_preset->setToolTip(tr("A starting point for a kind of recording"));

    auto *top = new QFormLayout;
    top->setContentsMargins(10, 8, 10, 6);
    top->setHorizontalSpacing(10);
    top->addRow(m_recording);
    top->addRow(tr("&Preset"), m_preset);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(m_form, 1);

    connect(m_preset, &QComboBox::activated, this, &PipelinePanel::applyPreset);
    connect(m_form, &SettingsForm::settingEdited, this, [this](const QString &name, const FieldValue &value) {
        m_controller.edit(name, value, tr("Change “%1”").arg(settingLabel(name)));
    });
    connect(m_form, &SettingsForm::resetRequested, this,
            [this] { m_controller.setSettings(firstSettings(m_document.openedSource()), tr("Reset all settings")); });
    connect(&document, &Document::opened, this, &PipelinePanel::showRecording);
    connect(&document, &Document::opened, this, &PipelinePanel::showSettings);
    connect(&document, &Document::settingsChanged, this, &PipelinePanel::showSettings);
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
        QStringLiteral("<b>%1</b><br>%2").arg(m_document.source().name().toHtmlEscaped(), words.toHtmlEscaped()));
}

void PipelinePanel::showSettings()
{
    m_form->setSettings(m_document.settings());
    m_form->setHzPerSecondOfABinAFrame(
        m_document.recording() ? hzPerSecondOfABinAFrame(m_document.settings().spectrogram, m_document.recording()->info()) : 0.0);
    for (const char *stage : {"selection", "spectrogram", "noise"})
        m_form->setSectionShown(QString::fromLatin1(stage), m_document.isEmpty() || m_document.recording());
    m_form->setSectionShown(QStringLiteral("conventional"), m_document.hasPings());
    const auto isTaken = [this](const Preset &preset) {
        return withSelection(preset.settings) == m_document.settings();
    };
    const auto taken = std::find_if(presets().begin(), presets().end(), isTaken);
    m_preset->setCurrentIndex(taken == presets().end() ? 0 : static_cast<int>(taken - presets().begin()) + 1);
}

void PipelinePanel::showNotes()
{
    const Analysis &analysis = *m_document.analysis();
    m_form->clearErrors();
    if (const auto *frames = dynamic_cast<const NormalisedSpectrogram *>(analysis.frames.get()))
        m_form->setNote(QStringLiteral("spectrogram.windowSeconds"),
                        tr("%1 s").arg(windowSeconds(frames->spectrogram()), 0, 'g', 4));
}

void PipelinePanel::showError(const Error &error)
{
    // "model.snr = -3" names a field.
    const QString name = QString::fromStdString(error.where()).section(QLatin1Char(' '), 0, 0);
    if (m_form->editor(name))
        m_form->setError(name, messageText(error.why()));
}

void PipelinePanel::applyPreset(int index)
{
    if (index == 0)
        return showSettings();
    m_controller.setSettings(withSelection(presets()[static_cast<std::size_t>(index - 1)].settings),
                             tr("Take preset “%1”").arg(m_preset->itemText(index)));
}

AnalysisSettings PipelinePanel::withSelection(AnalysisSettings settings) const
{
    settings.selection = m_document.settings().selection;
    return settings;
}

} // namespace faintline
