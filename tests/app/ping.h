#pragma once

#include "app/features/pictures/PingBench.h"
#include "app/window/MainWindow.h"
#include "support/find.h"

namespace faintline::test {

/// The ping that the maps show.
inline Index pingShown(MainWindow &window)
{
    return window.document().analysis()->time().nearest(window.pingBench().viewports().place().seconds);
}

/// What is read out at the cursor, whole.
inline QString readingOf(const PingBench &bench)
{
    return childOf<QLabel>(bench, QStringLiteral("Read-out")).accessibleDescription();
}

} // namespace faintline::test
