#pragma once

#include <QAbstractItemModel>
#include <QLabel>
#include <QTextDocumentFragment>
#include <QWidget>

#include <vector>

namespace faintline::test {

/// Finding what a user sees, by what it is or is called.

/// The only child of that accessible name; without a name, of its type.
template <class Child>
Child &childOf(const QWidget &widget, const QString &name = {})
{
    QList<Child *> found = widget.findChildren<Child *>();
    if (!name.isEmpty())
        found.removeIf([&](const Child *child) { return child->accessibleName() != name; });
    if (found.size() != 1)
        qFatal("%d children %s", int(found.size()), qPrintable(name));
    return *found.front();
}

/// The item of a type that is attached to a plot.
template <class Item, class Plot>
const Item &itemOf(const Plot &plot)
{
    for (const auto *item : plot.itemList())
        if (const auto *wanted = dynamic_cast<const Item *>(item))
            return *wanted;
    qFatal("no such item");
}

/// The text of a cell, with the minus sign of numbers that are typed.
inline QString cellOf(const QAbstractItemModel &table, int row, int column)
{
    return table.index(row, column).data().toString().replace(QChar(0x2212), '-');
}

/// The events of a table, in the order shown.
template <class Table>
std::vector<int> shownIds(const Table &events)
{
    const QAbstractItemModel &rows = *events.table()->model();
    std::vector<int> ids;
    for (int row = 0; row < rows.rowCount(); ++row)
        ids.push_back(rows.index(row, 0).data(Qt::UserRole).toInt());
    return ids;
}

/// What a label says, without its marks of HTML.
inline QString plainText(const QLabel &label)
{
    return QTextDocumentFragment::fromHtml(label.text()).toPlainText().replace(QChar(QChar::Nbsp), QLatin1Char(' '));
}

/// Whether a lesson's step is set up: it does not say that it is computing.
template <class Guide>
bool isReady(Guide &guide)
{
    for (const QLabel *label : guide.panel().template findChildren<QLabel *>())
        if (label->text().startsWith(QStringLiteral("Step ")))
            return guide.isRunning() && label->isVisible() && !label->text().endsWith(QStringLiteral("…"));
    return false;
}

} // namespace faintline::test
