#include "app/features/settings/MainSettings.h"

#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/SettingRow.h"

#include <QLabel>
#include <QVBoxLayout>

namespace faintline {

namespace {

    constexpr int labelWidth = 108;
    constexpr double mostBins = 100.0;
    constexpr double mostHertz = 1e9;

    /// Outside its section of the form; empty: the label says enough.
    QString labelAlone(const QString &name)
    {
        const QMap<QString, QString> labels{
            {QStringLiteral("model.lowestSlope"), MainSettings::tr("Drift from")},
            {QStringLiteral("model.highestSlope"), MainSettings::tr("Drift to")},
            {QStringLiteral("model.snr"), MainSettings::tr("Faintest SNR")},
            {QStringLiteral("detector.kind"), MainSettings::tr("Detector")},
            {QStringLiteral("selection.lowHz"), MainSettings::tr("Band from")},
            {QStringLiteral("selection.highHz"), MainSettings::tr("Band to")},
            {QStringLiteral("selection.fromSeconds"), MainSettings::tr("Time from")},
            {QStringLiteral("selection.toSeconds"), MainSettings::tr("Time to")},
        };
        return labels.value(name);
    }

} // namespace

const std::vector<const char *> &MainSettings::few()
{
    static const std::vector<const char *> names{"spectrogram.windowSeconds", "model.lowestSlope", "model.highestSlope",
                                                 "model.snr", "decide.falseAlarmsPerHour"};
    return names;
}

const std::vector<const char *> &MainSettings::dozen()
{
    static const std::vector<const char *> names{"spectrogram.windowSeconds",
                                                 "decide.falseAlarmsPerHour",
                                                 "model.lowestSlope",
                                                 "model.highestSlope",
                                                 "model.snr",
                                                 "detector.kind",
                                                 "selection.lowHz",
                                                 "selection.highHz",
                                                 "selection.fromSeconds",
                                                 "selection.toSeconds",
                                                 "subtract.lines",
                                                 "spectrogram.window"};
    return names;
}

MainSettings::MainSettings(Document &document, AnalysisController &controller, const std::vector<const char *> &names,
                           QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller)
{
    setAccessibleName(tr("Main settings"));
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 2, 8, 4);
    layout->setSpacing(1);
    for (const char *name : names) {
        const Field<AnalysisSettings> &field = settingField(name);
        auto *row = new SettingRow(field, defaultValue(field));
        row->setLabelWidth(labelWidth);
        if (const QString label = labelAlone(QString::fromLatin1(name)); !label.isEmpty())
            row->label()->setText(label);
        connect(row, &SettingRow::edited, this, [this, name = QString::fromLatin1(name)](const FieldValue &value) {
            m_controller.edit(name, value, tr("Change “%1”").arg(settingLabel(name)));
        });
        m_rows[QString::fromLatin1(name)] = row;
        layout->addWidget(row);
    }
    connect(&document, &Document::opened, this, [this] {
        showSettings();
        emit applicableChanged();
    });
    connect(&controller, &AnalysisController::failed, this, [this](const Error &error) {
        if (SettingRow *row = m_rows.value(QString::fromStdString(error.field())))
            row->setError(messageText(error.why()));
    });
    connect(&document, &Document::settingsChanged, this, &MainSettings::showSettings);
    connect(&document, &Document::analysisChanged, this, &MainSettings::showUsedSlopes);
    showSettings();
}

/// A window that the recording has chosen has a law of its own.
void MainSettings::showUsedSlopes()
{
    const Analysis &analysis = *m_document.analysis();
    const ModelSettings &used = analysis.settings.model;
    const bool isOther = analysis.choice && used != m_document.analysedSettings().model;
    const auto words = [isOther](double slope) {
        return isOther ? tr("%1 in the chosen window").arg(slope) : QString();
    };
    m_rows["model.lowestSlope"]->setNote(words(used.lowestSlope));
    m_rows["model.highestSlope"]->setNote(words(used.highestSlope));
}

bool MainSettings::isApplicable() const
{
    return m_document.recording() != nullptr;
}

void MainSettings::showSettings()
{
    const AnalysisSettings &settings = m_document.settings();
    const bool isHertz = settings.model.slopeUnit == SlopeUnit::HzPerSecond;
    for (auto row = m_rows.begin(); row != m_rows.end(); ++row) {
        const auto value = settingField(row.key().toStdString()).get(settings);
        row.value()->setVisible(value.has_value());
        row.value()->setError(QString());
        if (row.key().endsWith(QLatin1String("Slope")))
            row.value()->setUnit(isHertz ? tr("Hz/s") : tr("bins/frame"), isHertz ? mostHertz : mostBins);
        if (value)
            row.value()->setValue(*value);
    }
}

} // namespace faintline
