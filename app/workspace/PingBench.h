#pragma once

#include "app/workspace/Bench.h"
#include "app/document/Document.h"
#include "widgets/pings/PingMarks.h"
#include "widgets/pings/PingViewports.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QTimer>

class QLabel;
class QSlider;
class QSplitter;

namespace faintline {

class OutputLayers;
class PingMap;
class StripPlot;

/// A sonar's pings: input and statistic of one ping as maps of range × bearing, range and bearing of the tracks against time, ln K below.
///
/// The ping shown is the one the cursor stands on. All pictures have one range, one bearing, one time (PingViewports).
/// Keys: J and L step, Space plays, Shift+Space plays backwards, P looks from above.
class PingBench : public Bench
{
    Q_OBJECT

public:
    /// `layers`: the window's, shown over the output's map as well.
    PingBench(Document &document, OutputLayers &layers, QWidget *parent = nullptr);

    PingMap *input() const { return m_input; }
    PingMap *output() const { return m_output; }
    WaterfallView *rangeHistory() const { return m_rangeHistory; }
    WaterfallView *bearingHistory() const { return m_bearingHistory; }
    QWidget *histories() const;
    QWidget *maps() const;
    PingViewports &viewports() { return m_viewports; }

    Index ping() const; ///< the one shown
    QString reading() const;

    void setEmptySentence(const QString &sentence) override;
    ViewState viewState() const override;
    void restore(const ViewState &view) override;
    void cycleOrientation() override;
    void cycleColourMap() override;
    void setAutomaticRange() override;

public slots:
    void selectEvent(int id) override;
    void stepFrames(int frames) override;
    void setPlaying(bool isPlaying) override;
    void setPlayingBackward(bool isPlaying);
    void setPolar(bool isPolar);
    void showPing(faintline::Index ping);

protected:
    /// Gives up what would leave the maps no room.
    void resizeEvent(QResizeEvent *event) override;
    std::vector<QSplitter *> splitters() const override { return {m_maps, m_histories, m_rows}; }

private:
    QWidget *buildBar();
    void linkViews();
    std::vector<WaterfallView *> views() const;
    void showAnalysis();
    void showHeading();
    void showRegulation();
    void showThreshold();
    void showEvents();
    const PeakPyramid *provisional() const;
    void showStatistic();
    void followExtents();
    void placeCursor();
    void followPlace();
    void showMarks();
    void read(double range, double bearing);
    void readCursor();
    void startPlaying(int step);
    void play();

    Document &m_document;
    OutputLayers &m_layers;
    PingViewports m_viewports;
    PingMap *m_input;
    PingMap *m_output;
    WaterfallView *m_rangeHistory;
    WaterfallView *m_bearingHistory;
    StripPlot *m_regulation;
    QLabel *m_dragged;  ///< a warning where signals drag K down
    QSlider *m_slider;
    QLabel *m_reading;
    QSplitter *m_maps;
    QSplitter *m_histories;
    QSplitter *m_rows;
    PingMarks m_marks;
    Index m_shownPing = -1; ///< whose pictures the maps show; -1: none
    int m_playStep = 1;
    QTimer m_player;
    bool m_isFirstAnalysis = true; ///< of what is open
    bool m_isFollowing = false;
};

} // namespace faintline
