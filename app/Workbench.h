#pragma once

#include "app/Document.h"
#include "app/Session.h"
#include "widgets/ReadOut.h"
#include "widgets/WaterfallView.h"

#include <QTimer>
#include <QWidget>

class QSplitter;

namespace faintline {

class StripPlot;

/// The pictures: input and statistic side by side on one viewport, each with its colour bar; curves along time below.
class Workbench : public QWidget
{
    Q_OBJECT

public:
    explicit Workbench(Document &document, QWidget *parent = nullptr);

    WaterfallView *input() const { return m_input; }
    WaterfallView *output() const { return m_output; }
    QWidget *inputPane() const { return m_inputPane; } ///< with its colour bar
    QWidget *outputPane() const { return m_outputPane; }

    /// What the panes say while there is nothing to see.
    void setEmptySentence(const QString &sentence);

    ViewState viewState() const;
    void restore(const ViewState &view);

    QByteArray saveSplitters() const;
    void restoreSplitters(const QByteArray &state);

public slots:
    void selectEvent(int id); ///< marks it, puts the cursor on it and brings it into view
    void stepFrames(int frames);
    void setPlaying(bool isPlaying);

protected:
    /// The curves give way where there is little height: the pictures come first.
    void resizeEvent(QResizeEvent *event) override;

signals:
    void eventActivated(int id);
    void thresholdStepRequested(int quarterNats);
    void readingChanged(const faintline::ReadOut::Reading &reading);
    void playingChanged(bool isPlaying);

private:
    void linkViews();
    void showAnalysis();
    void showThreshold();
    void showEvents();
    void followExtents(const Analysis &analysis, bool isFirst);
    void placeCursor();
    void read(const Viewport::Point &point);
    void readCursor();
    void play();

    Document &m_document;
    WaterfallView *m_input;
    WaterfallView *m_output;
    QWidget *m_inputPane;
    QWidget *m_outputPane;
    StripPlot *m_statistic;
    StripPlot *m_regulation;
    QSplitter *m_pictures;
    QSplitter *m_rows;
    QTimer m_player;
    bool m_isFirstAnalysis = true; ///< of what is open
};

} // namespace faintline
