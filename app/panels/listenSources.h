#pragma once

#include "app/control/LiveRun.h"

#include <QString>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

namespace faintline {

/// Asks for what one kind of source needs to be known.
class ListenSourceForm : public QWidget
{
public:
    /// As filled in. Throws Error of what is missing or wrong.
    virtual LiveRun::OpenSource source() const = 0;
    /// What a second of it takes on the disk; none: its header or its device will tell.
    virtual std::optional<double> bytesPerSecond() const = 0;
};

/// A kind of source that the window can listen to. Another one is another row of the table.
struct ListenSourceKind {
    QString name;
    std::function<ListenSourceForm *()> makeForm;
};

const std::vector<ListenSourceKind> &listenSourceKinds();

} // namespace faintline
