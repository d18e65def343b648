#pragma once

#include "widgets/waterfall/MarkedWaterfall.h"

#include <memory>

class QMenu;

namespace faintline {

class WaterfallMouse;

/// A marked picture with mouse and keyboard control. Gestures change its viewport, display and direction, which other
/// pictures may share; changes of the document are requested with signals `…Requested`.
///
/// WaterfallMouse handles buttons, waterfallCommands keys and the context menu.
class WaterfallView : public MarkedWaterfall
{
    Q_OBJECT

public:
    explicit WaterfallView(const QString &heading, PictureDisplay *display = nullptr,
                           TimeDirection *direction = nullptr);
    ~WaterfallView() override;

signals:
    /// Emitted before the context menu opens, so that actions can be added. The point is the position of the click.
    void contextMenuRequested(QMenu *menu, double seconds, double hz);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;

private:
    std::unique_ptr<WaterfallMouse> m_mouse;
};

} // namespace faintline
