#pragma once

#include "widgets/waterfall/MarkedWaterfall.h"

#include <memory>

class QMenu;

namespace faintline {

class WaterfallMouse;

/// A marked picture that answers mouse and keyboard. Looking (zooming, colours, orientation) is the view's own affair
/// and is told by signals that say `…Changed`; what touches the document is only asked for by signals that say
/// `…Requested`.
///
/// What a button does is WaterfallMouse's, what a key or the context menu does waterfallCommands'.
class WaterfallView : public MarkedWaterfall
{
    Q_OBJECT

public:
    explicit WaterfallView(const QString &heading, QWidget *parent = nullptr);
    ~WaterfallView() override;

signals:
    /// Emitted before the context menu opens: add actions to it. The point is where it was asked for.
    void contextMenuRequested(QMenu *menu, double seconds, double hz);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;

private:
    std::unique_ptr<WaterfallMouse> m_mouse;
};

} // namespace faintline
