#include "app/features/inspect/InfoPanel.h"

#include "app/base/tr.h"
#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "app/document/statisticUnit.h"
#include "app/document/thresholdWords.h"
#include "app/features/inspect/NoiseCheck.h"
#include "base/utc.h"
#include "noise/NoiseNormaliser.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include "analyse/events.h"
#include "base/numberText.h"
#include "calibrate/falseAlarmWords.h"
#include "refine/subtractLines.h"

#include <QCoreApplication>
#include <QLabel>
#include <QVBoxLayout>

#include <cmath>

namespace faintline {

namespace {

    /// Rows of a two-column table.
    class Rows
    {
    public:
        void heading(const QString &text)
        {
            m_html += QStringLiteral("<tr><td colspan=2 style='padding-top:8px'><b>%1</b></td></tr>")
                          .arg(text.toHtmlEscaped());
        }
        void row(const QString &name, const QString &value)
        {
            m_html += QStringLiteral("<tr><td style='padding-right:14px'>%1</td><td>%2</td></tr>")
                          .arg(name.toHtmlEscaped(), value.toHtmlEscaped());
        }
        void note(const QString &text)
        {
            m_html += QStringLiteral("<tr><td colspan=2>%1</td></tr>").arg(text.toHtmlEscaped());
        }
        QString html() const { return QStringLiteral("<table>") + m_html + QStringLiteral("</table>"); }

    private:
        QString m_html;
    };

    QString withUnit(double value, int digits, const char *unit)
    {
        return numberText(value, digits) + QLatin1Char(' ') + QLatin1String(unit);
    }

    void describeRecording(Rows &rows, const RecordingInfo &info)
    {
        rows.heading(tr("Recording"));
        rows.row(tr("Format"),
                 labelText(info.container + ", " + info.sampleType) + (info.isComplex ? tr(", I/Q") : QString()));
        rows.row(tr("Sample rate"), QString::fromStdString(formatPlainly(info.sampleRateHz)) + tr(" Hz"));
        rows.row(tr("Length"), secondsText(info.durationSeconds(), 1e-3 * info.durationSeconds()));
        rows.row(tr("Channels"), QString::number(info.channelCount));
        if (info.centreHz != 0.0)
            rows.row(tr("Centre frequency"), QString::fromStdString(formatPlainly(info.centreHz)) + tr(" Hz"));
        if (info.startUnixSeconds)
            rows.row(tr("Start"), QString::fromStdString(formatUtc(*info.startUnixSeconds)));
        for (const std::string &note : info.notes)
            rows.note(messageText(note));
    }

    void describeReadyFrames(Rows &rows, const Analysis &analysis)
    {
        const Axis &time = analysis.time();
        rows.heading(capitalised(frameKindOf(analysis.grid()).frames));
        rows.row(tr("Number"), tr("%1, every %2 s").arg(time.count).arg(time.step, 0, 'g', 4));
        for (const Axis &axis : analysis.grid().axes)
            rows.row(capitalised(labelText(axis.name, mostUnitLetters)),
                     tr("%1 cells of %2 %3%4")
                         .arg(axis.count)
                         .arg(axis.step, 0, 'g', 4)
                         .arg(labelText(axis.unit, mostUnitLetters), axis.cyclic ? tr(", full circle") : QString()));
        rows.row(tr("States"), QString::number(analysis.model.space.stateCount()));
        if (analysis.lnKBand.deviation > 0.0)
            rows.row(tr("ln K on noise"),
                     tr("%1 … %2 nat").arg(analysis.lnKBand.low(), 0, 'f', 3).arg(analysis.lnKBand.high(), 0, 'f', 3));
    }

    void describeFrames(Rows &rows, const Analysis &analysis)
    {
        if (!analysis.recording)
            return describeReadyFrames(rows, analysis);
        const Axis &frequency = analysis.grid().axes.back();
        rows.heading(tr("Spectra"));
        rows.row(tr("Window T_FT"), tr("%1 s").arg(analysis.frames->geometry().windowSeconds, 0, 'g', 4));
        rows.row(tr("Frames"), tr("%1, every %2 s").arg(analysis.time().count).arg(analysis.time().step, 0, 'g', 4));
        rows.row(tr("Bins"), tr("%1, every %2 Hz").arg(frequency.count).arg(frequency.step, 0, 'g', 4));
        if (const std::string words = subtractionWords(analysis); !words.empty())
            rows.row(tr("Subtracted"), messageText(words));
    }

    void describeCalibration(Rows &rows, const Analysis &analysis, bool isBusy)
    {
        const Calibration &calibration = *analysis.calibration;
        const double eventRate = calibration.eventRateAt(analysis.threshold);
        rows.heading(tr("Detector on noise"));
        const QString unit = statisticUnit(analysis.settings);
        rows.row(tr("Threshold"), tr("%1 ± %2 %3")
                                      .arg(analysis.threshold, 0, 'f', 2)
                                      .arg(calibration.thresholdUncertainty(eventRate), 0, 'f', 2)
                                      .arg(unit));
        rows.row(tr("False alarms"),
                 QString::fromStdString(falseAlarmWords(eventRate * analysis.cellFramesPerHour,
                                                        calibration.rateUncertaintyAt(analysis.threshold))));
        if (calibration.isFirstEstimate)
            rows.note(firstEstimateSentence(analysis, isBusy));
        rows.row(tr("Pfa per cell"), powerText(calibration.exceedanceAt(analysis.threshold)));
        rows.row(tr("ln K"), withUnit(calibration.lnK, 3, "nat"));
        rows.row(tr("Paths continued"), withUnit(100.0 * calibration.continuedFraction, 1, "%"));
        rows.row(tr("Tail e^(-θT), θ"), tr("%1 ± %2 per %3")
                                            .arg(calibration.tailSlope, 0, 'f', 3)
                                            .arg(calibration.slopeError, 0, 'f', 3)
                                            .arg(unit));
    }

} // namespace

InfoPanel::InfoPanel(const Document &document, AnalysisController &controller, RecordingCheck &check, QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller), m_label(new QLabel),
      m_check(new NoiseCheck(document, controller, check))
{
    m_label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    m_label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    m_label->setMargin(10);
    m_label->setWordWrap(true);
    auto *content = new QWidget;
    auto *column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_check);
    column->addWidget(m_label, 1);
    setScrolledColumn(*this, content, Qt::ScrollBarAsNeeded);

    connect(&document, &Document::opened, this, &InfoPanel::refresh);
    connect(&document, &Document::analysisChanged, this, &InfoPanel::refresh);
    connect(&controller, &AnalysisController::busyChanged, this, &InfoPanel::refresh);
    refresh();
}

void InfoPanel::refresh()
{
    if (m_document.isEmpty())
        return m_label->setText(tr("Open a recording to see its properties."));
    Rows rows;
    if (m_document.recording())
        describeRecording(rows, m_document.recording()->info());
    if (m_document.recording() && m_document.recording()->nonFiniteCount() > 0)
        rows.note(tr("Some samples are not finite; frames that reach into them are not observed."));
    if (m_document.analysis()) {
        describeFrames(rows, *m_document.analysis());
        describeCalibration(rows, *m_document.analysis(), m_controller.isBusy());
        if (const std::string words = unreportedWords(*m_document.analysis()); !words.empty())
            rows.note(messageText(words));
    }
    m_label->setText(rows.html());
}

} // namespace faintline
