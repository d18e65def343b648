#include "app/panels/MainSettings.h"

#include "app/control/AnalysisController.h"
#include "app/document/Document.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/SettingRow.h"

#include <QVBoxLayout>

namespace faintline {

namespace {

    constexpr const char *names[]{"spectrogram.windowSeconds", "model.lowestSlope", "model.highestSlope", "model.snr",
                                  "decide.falseAlarmsPerHour"};
    constexpr int labelWidth = 108;
    constexpr double mostBins = 100.0;
    constexpr double mostHertz = 1e9;

} // namespace

MainSettings::MainSettings(Document &document, AnalysisController &controller, QWidget *parent)
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
