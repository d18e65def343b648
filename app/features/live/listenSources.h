#pragma once

#include "app/features/live/LiveRun.h"

#include <QString>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

namespace faintline {

/// Form for the settings of one kind of source.
class ListenSourceForm : public QWidget
{
public:
    /// The source as filled in. Throws Error if a value is missing or wrong.
    virtual LiveRun::OpenSource source() const = 0;
    /// Bytes per second on disk; empty: known only from the header or the device.
    virtual std::optional<double> bytesPerSecond() const = 0;
};

/// A kind of source that the window can listen to. To add one, add a row to the table.
struct ListenSourceKind {
    QString name;
    std::function<ListenSourceForm *()> makeForm;
};

const std::vector<ListenSourceKind> &listenSourceKinds();

} // namespace faintline
