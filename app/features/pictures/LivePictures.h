#pragma once

#include "app/document/Document.h"

#include <QElapsedTimer>

namespace faintline {

class Closeup;
class StripPlot;
class WaterfallView;

/// Shows a live run in the pictures of lines: they grow by its newest frames, with the tracks in sight.
class LivePictures : public QObject
{
    Q_OBJECT

public:
    /// `statistic`: the curve below the pictures.
    LivePictures(Document &document, WaterfallView &input, WaterfallView &output, StripPlot &statistic,
                 QObject *parent = nullptr);

    /// Of the live picture shown; null if there is none.
    const std::shared_ptr<const AnalysisPlan> &plan() const { return m_plan; }
    void show(const Closeup &closeup); ///< the document's newest frames
    void clear();                      ///< what is shown next is no live run, or another one
    bool isStripDue();                 ///< a few times a second while there is a cursor

signals:
    void planChanged();
    /// A picture was painted this long after the last sample of its newest frame.
    void painted(double secondsLater);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< detects when the picture is painted

private:
    void showTracks();
    void growExtents(bool isFirst);
    void markChanges();

    Document &m_document;
    WaterfallView &m_input;
    WaterfallView &m_output;
    StripPlot &m_statistic;
    QElapsedTimer m_stripAge;
    std::shared_ptr<const AnalysisPlan> m_plan;
    Index m_colouredFrames = 0; ///< number of frames when the colours were chosen
    bool m_isToBePainted = false;
};

} // namespace faintline
