#pragma once

#include "app/features/pictures/Bench.h"
#include "widgets/pings/PingMarks.h"
#include "widgets/pings/PingViewports.h"

class QSplitter;

namespace faintline {

class PingBar;
class PingMap;
class PingRegulation;
class ShownAxes;

/// Sonar pings and a radar's scans: input and statistic of one ping as maps of two of its axes, such as range ×
/// bearing; below, the tracks along both axes against time, and ln K. Pictures whose time runs from left to right are
/// stacked on one time axis.
///
/// The ping at the cursor is shown. All pictures share the two axes and one time axis (PingViewports). Axes that are
/// not shown are reduced to their maxima, or cut at the cursor. Keys: J and L step, Space plays, Shift+Space plays
/// backwards, P shows the map from above.
class PingBench : public Bench
{
    Q_OBJECT

public:
    /// `layers`: layers of the window, also drawn over the output map.
    PingBench(Document &document, OutputLayers &layers, QWidget *parent = nullptr);

    PingMap *input() const { return m_input; }
    PingMap *output() const { return m_output; }
    WaterfallView *alongHistory() const { return m_alongHistory; }
    WaterfallView *acrossHistory() const { return m_acrossHistory; }
    QWidget *inputView() const override;
    QWidget *outputView() const override;
    WaterfallView *firstView() const override;
    QString firstViewName() const override { return QStringLiteral("map"); }
    bool hasReadOut() const override { return true; }
    QString hint() const override;
    OutputLayers &layers() const override { return m_layers; }
    QWidget *histories() const;
    QWidget *maps() const;
    PingViewports &viewports() { return m_viewports; }
    ShownAxes &axes() { return *m_axes; }
    Place place() const override;
    void setPlace(const Place &place) override;

    void setEmptySentence(const QString &sentence) override;
    ViewState viewState() const override;
    void restore(const ViewState &view) override;

public slots:
    void stepFrames(int frames) override;
    void setPlayingBackward(bool isPlaying);
    void setPolar(bool isPolar);
    /// Shows the other parts only if the maps are tall enough to place something on them.
    void setMapsFirst(bool areFirst);
    void showPing(faintline::Index ping);

protected:
    void showWhatFits() override;
    std::vector<QSplitter *> splitters() const override { return {m_maps, historyPanes(), rows()}; }
    void showAnalysis() override;
    void showStatistic() override;
    void showThreshold() override;
    void readCursor() override;
    void showMarks() override;
    void markSelected(int track) override;
    void goTo(const Event &event) override;
    void setColourBarShown(bool isShown) override;
    void showStatisticUnit(const QString &unit) override;
    const PeakPyramid *provisional() const override;
    int framesToPlay(int direction) const override;

private:
    Index ping() const; ///< the ping shown
    void layOut();
    void buildHistories();
    void linkViews();
    void linkBar();
    void followExtents();
    void placeCursor();
    void followPlace();
    void linkAxes();
    void showAxes();
    void followProjection();
    void read(double along, double across);

    OutputLayers &m_layers;
    PingViewports m_viewports;
    TimeDirection m_mapDirection;
    TimeDirection m_historyDirection{TimeDirection::Orientation::LeftToRight};
    PingMap *m_input;
    PingMap *m_output;
    PingBar *m_bar;    ///< below the maps
    ShownAxes *m_axes; ///< with a bar above them
    WaterfallView *m_alongHistory;
    WaterfallView *m_acrossHistory;
    PingRegulation *m_regulation;
    QSplitter *m_maps;
    PingMarks m_marks;
    Index m_shownPing = -1; ///< ping shown in the maps; -1: none
    bool m_areMapsFirst = false;
};

} // namespace faintline
