#pragma once

#include "plan/Calibration.h"
#include "widgets/base/Span.h"
#include "widgets/base/ThemedPlot.h"

#include <QPolygonF>

#include <memory>
#include <optional>
#include <vector>

class QMenu;
class QwtPlotCurve;
class QwtPlotGrid;
class QwtPlotHistogram;
class QwtPlotMarker;

namespace faintline {

class CanvasSentence;
class CurveKey;
class LineLabel;

/// Plot for tuning the threshold: how often noise exceeds it, and the values of this recording.
///
/// Abscissa: the statistic in nats. Left ordinate, logarithmic: P(D > T) of a noise cell (simulated for these settings,
/// its exponential tail, a closed form if there is one, and measured in the recording), or events on noise in false
/// alarms per hour. Right ordinate: number of cells of this recording per quarter nat. The threshold line is dragged
/// with the mouse (anywhere on the canvas) or moved with `,` and `.` by a quarter nat.
class ExceedancePlot : public ThemedPlot
{
    Q_OBJECT

public:
    /// Unit of the threshold; FalseAlarmsPerHour also changes the left ordinate.
    enum class Unit { Nats, PfaPerCell, FalseAlarmsPerHour };
    Q_ENUM(Unit)

    explicit ExceedancePlot(QWidget *parent = nullptr);
    ~ExceedancePlot() override;

    /// Null: shows a sentence instead of curves.
    void setCalibration(std::shared_ptr<const Calibration> calibration, double cellFramesPerHour);
    /// Analysis::statisticCounts: cells whose D lies in [i/4 - 4, (i+1)/4 - 4) nat.
    void setHistogram(const std::vector<double> &counts);
    /// Points (nat, P(D > nat)) of a closed form; empty for none.
    void setClosedForm(const QPolygonF &points);
    /// The same, measured in a box of this recording that holds only noise; empty for none.
    void setSelectionExceedance(const QPolygonF &points);

    /// Unit of the statistic, by default "nat".
    void setStatisticUnit(const QString &unit);

    /// False alarms on this recording's noise: ratio to those on the calibration's noise, or "more" or "fewer" if they
    /// were not counted.
    struct OwnNoise {
        std::optional<double> ratio;
        QString words;
        bool operator==(const OwnNoise &) const = default;
    };
    /// Shown in the threshold's label beside the rate; an empty value removes it.
    void setOwnNoise(const OwnNoise &noise);

    double threshold() const { return m_threshold; }
    Unit unit() const { return m_unit; }

    /// Label of the line: the threshold, the rate on this recording's own noise, nats.
    QString labelText() const;

    QSize sizeHint() const override { return {380, 260}; }
    QSize minimumSizeHint() const override { return {240, 170}; }

public slots:
    void setThreshold(double nats);
    void setUnit(faintline::ExceedancePlot::Unit unit);

signals:
    void thresholdRequested(double nats);                     ///< live, while dragging
    void thresholdCommitted(double nats);                     ///< at release, or after a key
    void unitRequested(faintline::ExceedancePlot::Unit unit); ///< chosen in the menu
    void contextMenuRequested(QMenu *menu);                   ///< emitted before it is shown: others may add actions

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    void restyle() override;
    void followCanvas() override { layAxes(); }

private:
    /// The threshold in words, in the chosen unit: "14.2 nat", "Pfa 3·10⁻⁷ per cell", "0.8 false alarms/h".
    QString thresholdText() const;
    void layAxes();
    void updateCurves();
    void drawNoise();
    void drawRecording();
    void nameCurves();
    void updateThresholdLine();
    QString ownNoiseText() const;
    void dragTo(double canvasX);
    void step(int quarterNats);
    bool isRate() const { return m_unit == Unit::FalseAlarmsPerHour; }
    double ordinate(double nats) const;
    Span natSpan() const;

    std::shared_ptr<const Calibration> m_calibration;
    double m_cellFramesPerHour = 0.0;
    std::vector<double> m_counts;
    QPolygonF m_closedFormPoints;
    QPolygonF m_selectionPoints;
    OwnNoise m_ownNoise;
    double m_threshold = 20.0;
    Unit m_unit = Unit::FalseAlarmsPerHour;
    QString m_statisticUnit = QStringLiteral("nat");
    bool m_isDragging = false;

    QwtPlotGrid *m_grid;
    QwtPlotHistogram *m_histogram;
    QwtPlotCurve *m_simulated;
    QwtPlotCurve *m_tail;
    QwtPlotCurve *m_closedForm;
    QwtPlotCurve *m_measured;
    QwtPlotCurve *m_selection;
    QwtPlotMarker *m_line;
    LineLabel *m_label;
    CanvasSentence *m_sentence;
    CurveKey *m_key;
};

} // namespace faintline
