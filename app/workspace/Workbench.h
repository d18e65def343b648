#pragma once

#include "app/workspace/Bench.h"
#include "widgets/base/ReadOut.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QElapsedTimer>
#include <QTimer>

class QSplitter;

namespace faintline {

class BoxMeter;
class Closeup;
class OutputLayers;
class StripPlot;

/// The pictures: input and statistic on one viewport, each with its colour bar; time curves below. The pictures are
/// side by side, or, if time runs from left to right, above each other on the time axis of the curves.
class Workbench : public Bench
{
    Q_OBJECT

public:
    explicit Workbench(Document &document, QWidget *parent = nullptr);

    WaterfallView *input() const { return m_input; }
    WaterfallView *output() const { return m_output; }
    QWidget *inputView() const override { return m_inputPane; }
    QWidget *outputView() const override { return m_outputPane; }
    QWidget *firstView() const override { return m_output; }
    QString firstViewName() const override { return QStringLiteral("output"); }
    bool hasReadOut() const override { return false; }
    bool eventFilter(QObject *watched, QEvent *event) override; ///< detects when a live picture is painted
    QString hint() const override;
    TimeStack &timeStack() override { return *m_stack; }

    Place place() const override;
    void setPlace(const Place &place) override;
    OutputLayers &layers() { return *m_layers; }
    Closeup &closeup() { return *m_closeup; }
    StripPlot *statisticPlot() const { return m_statistic; }
    StripPlot *regulationPlot() const { return m_regulation; }

    void setEmptySentence(const QString &sentence) override;
    ViewState viewState() const override;
    void restore(const ViewState &view) override;
    void cycleOrientation() override { m_output->cycleOrientation(); }
    void cycleColourMap() override { m_output->cycleColourMap(); }
    void setAutomaticRange() override;
    /// Labels frequencies as radio frequencies if the recording has a centre frequency.
    void setRadioAxis(bool isOn);
    bool isRadioAxis() const { return m_isRadioAxis; }

public slots:
    void selectEvent(int id) override;
    void stepFrames(int frames) override;
    void setPlaying(bool isPlaying) override;

protected:
    std::vector<QSplitter *> splitters() const override { return {m_pictures, m_rows}; }
    void showAnalysis() override;
    void showHeading() override;
    void showStatistic() override;
    void showThreshold() override;
    void showEvents() override;
    void readCursor() override;

    /// Hides the curves if the window is too low; the pictures have priority.
    void resizeEvent(QResizeEvent *event) override;

signals:
    void readingChanged(const faintline::ReadOut::Reading &reading);
    /// A live picture was painted this long after the last sample of its newest frame.
    void livePainted(double secondsLater);

private:
    void linkViews();
    void showOrigin();
    void showPictures(const PicturesSoFar &pictures);
    void followExtents(const Axis &time, const Axis &frequency);
    void showLive();
    void showLiveTracks();
    void growExtents(const LiveView &live);
    bool isStripDue();
    void markChanges();
    void arrange();
    void showStrips();
    void placeCursor();
    void read(const Viewport::Point &point);
    void play();

    WaterfallView *m_input;
    WaterfallView *m_output;
    OutputLayers *m_layers;
    BoxMeter *m_boxMeter;
    Closeup *m_closeup;
    QWidget *m_inputPane;
    QWidget *m_outputPane;
    StripPlot *m_statistic;
    StripPlot *m_regulation;
    QSplitter *m_pictures;
    QSplitter *m_rows;
    TimeStack *m_stack;
    QTimer m_player;
    bool m_isFirstAnalysis = true; ///< of the open source
    bool m_isFirstPicture = true;
    QElapsedTimer m_stripAge;                       ///< of a live run's curve
    std::shared_ptr<const AnalysisPlan> m_livePlan; ///< of the live picture shown
    Index m_colouredFrames = 0;                     ///< number of frames when its colours were chosen
    bool m_isToBePainted = false;
    bool m_isRadioAxis = false;
};

} // namespace faintline
