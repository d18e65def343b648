#pragma once

#include "app/features/pictures/Bench.h"
#include "widgets/base/ReadOut.h"

class QSplitter;

namespace faintline {

class Closeup;
class LivePictures;
class PlainInput;
class RegulationPlot;
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
    WaterfallView *firstView() const override { return m_output; }
    QString firstViewName() const override { return QStringLiteral("output"); }
    bool hasReadOut() const override { return false; }
    QString hint() const override;
    OutputLayers &layers() const override { return *m_layers; }

    Place place() const override;
    void setPlace(const Place &place) override;
    Closeup &closeup() { return *m_closeup; }
    PlainInput &plainInput() { return *m_plainInput; }
    LivePictures &live() { return *m_live; }
    StripPlot *statisticPlot() const { return m_statistic; }
    StripPlot *regulationPlot() const;

    void setEmptySentence(const QString &sentence) override;
    ViewState viewState() const override;
    void restore(const ViewState &view) override;
    /// Labels frequencies as radio frequencies if the recording has a centre frequency.
    void setRadioAxis(bool isOn);
    bool isRadioAxis() const { return m_isRadioAxis; }
    /// Whether the share of continued states and ln K are shown over time, where there is room.
    void setRegulationWanted(bool isWanted);
    /// Where only one chart fits below the pictures, it is ln K instead of the statistic.
    void setRegulationFirst(bool isFirst);

public slots:
    void stepFrames(int frames) override;
    void setPlaying(bool isPlaying) override;

protected:
    std::vector<QSplitter *> splitters() const override { return {historyPanes(), rows()}; }
    void showAnalysis() override;
    void showStatistic() override;
    void showThreshold() override;
    void readCursor() override;
    void reveal(const Track &track) override;
    void goTo(const Event &event) override;
    void setColourBarShown(bool isShown) override;
    void showStatisticUnit(const QString &unit) override;
    int framesToPlay(int direction) const override;
    void showWhatFits() override;

signals:
    void readingChanged(const faintline::ReadOut::Reading &reading);

private:
    static QString inputHeading(bool isRest);
    void linkViews();
    void showOrigin();
    void showInput();
    void showPictures(const PicturesSoFar &pictures);
    void followExtents(const Axis &time, const Axis &frequency);
    void placeCursor();
    void read(const Viewport::Point &point);

    WaterfallView *m_input;
    WaterfallView *m_output;
    OutputLayers *m_layers;
    Closeup *m_closeup;
    PlainInput *m_plainInput;
    QWidget *m_inputPane;
    QWidget *m_outputPane;
    StripPlot *m_statistic;
    RegulationPlot *m_regulation;
    LivePictures *m_live;
    bool m_isFirstPicture = true; ///< of the open source
    bool m_isRadioAxis = false;
    bool m_isRegulationWanted = true;
    bool m_isRegulationFirst = false;
};

} // namespace faintline
