#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "inspect/closeup.h"

namespace faintline {

class WaterfallView;

/// Shows single frames when the user zooms into a long recording, whose pictures have rows of many frames: the visible
/// part is computed again on a worker, the input first, and replaces the merged rows as soon as it is complete.
///
/// Only the newest view is computed; a change of the view cancels the work for the previous one. Does nothing if rows
/// are single frames already.
class Closeup : public QObject
{
    Q_OBJECT

public:
    Closeup(Document &document, WaterfallView &input, WaterfallView &output, QObject *parent = nullptr);

    /// A live run's picture as it is being looked back at; null where its newest frames are seen, which are single.
    std::shared_ptr<const PeakPyramid> lookedBackAt(const WaterfallView &view) const;

signals:
    void shown();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< the view's canvas: another size, other pixels

private:
    std::shared_ptr<const Analysis> current() const;
    bool showsNewest() const;
    FrameStretch wanted() const;
    void follow();
    void show();
    void begin(const std::shared_ptr<const Analysis> &analysis, const FrameStretch &stretch);
    void forget();

    Document &m_document;
    WaterfallView &m_input;
    WaterfallView &m_output;
    std::shared_ptr<const Analysis> m_analysis; ///< that all of this is of
    FrameStretch m_stretch;                     ///< shown, or being made
    FrameStretch m_waiting;                     ///< to be made next
    std::shared_ptr<const PeakPyramid> m_inputStretch;
    std::shared_ptr<const PeakPyramid> m_statisticStretch;
    JobRunner m_runner{this}; ///< last, so that its jobs end first
};

} // namespace faintline
