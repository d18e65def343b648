#include "widgets/table/ColumnTable.h"

#include "widgets/base/Theme.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QSortFilterProxyModel>

#include <algorithm>

namespace faintline {

namespace {

    /// As a field of CSV, with the minus sign that programs read.
    QString csvField(QString text)
    {
        text.replace(QChar(0x2212), QLatin1Char('-'));
        const bool isPlain = std::ranges::none_of(text, [](QChar c) { return c == ',' || c == '"' || c == '\n'; });
        return isPlain ? text : QLatin1Char('"') + text.replace('"', QLatin1String("\"\"")) + QLatin1Char('"');
    }

} // namespace

ColumnTable::ColumnTable(const QString &accessibleName, QWidget *parent)
    : QTableView(parent), m_own(new ColumnModel(this))
{
    constexpr int rowHeight = 22;
    setAccessibleName(accessibleName);
    verticalHeader()->hide();
    verticalHeader()->setDefaultSectionSize(rowHeight);
    horizontalHeader()->setHighlightSections(false);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setShowGrid(false);
    setFrameShape(QFrame::NoFrame);
    show(*m_own);

    // Only a table that is sorted has an arrow, for which all its headings keep room.
    horizontalHeader()->setSortIndicatorClearable(true);
    connect(horizontalHeader(), &QHeaderView::sectionClicked, this, [this](int column) {
        if (!isSortingEnabled())
            sortByColumn(column, Qt::AscendingOrder);
        setSortingEnabled(true);
    });
    auto *copying = new QAction(tr("Copy"), this);
    copying->setShortcut(QKeySequence::Copy);
    copying->setShortcutContext(Qt::WidgetShortcut);
    connect(copying, &QAction::triggered, this, &ColumnTable::copy);
    addAction(copying);
    setContextMenuPolicy(Qt::ActionsContextMenu);
}

void ColumnTable::show(ColumnModel &model, QSortFilterProxyModel *proxy)
{
    if (proxy || !m_proxy)
        m_proxy = proxy ? proxy : new QSortFilterProxyModel(this);
    m_proxy->setSortRole(ColumnModel::SortRole);
    m_proxy->setSourceModel(&model);
    setModel(m_proxy);
}

void ColumnTable::setSmall(int rowHeight)
{
    verticalHeader()->setDefaultSectionSize(rowHeight);
    setFont(Theme::font(12));
    horizontalHeader()->setFont(Theme::font(12));
    horizontalHeader()->setMinimumSectionSize(24);
}

int ColumnTable::sourceRow(const QModelIndex &index) const
{
    return m_proxy->mapToSource(index).row();
}

std::vector<int> ColumnTable::selectedSourceRows() const
{
    QModelIndexList selected = selectionModel()->selectedRows();
    std::ranges::sort(selected, {}, &QModelIndex::row);
    std::vector<int> rows;
    for (const QModelIndex &index : selected)
        rows.push_back(sourceRow(index));
    return rows;
}

QList<int> ColumnTable::shownColumns() const
{
    QList<int> columns;
    for (int place = 0; place < horizontalHeader()->count(); ++place)
        if (const int column = horizontalHeader()->logicalIndex(place); !isColumnHidden(column))
            columns << column;
    return columns;
}

QStringList ColumnTable::textsOf(int row) const
{
    QStringList texts;
    for (const int column : shownColumns())
        texts << model()->index(row, column).data().toString();
    return texts;
}

std::string ColumnTable::csv() const
{
    QStringList headings;
    for (const int column : shownColumns())
        headings << csvField(model()->headerData(column, Qt::Horizontal).toString());
    QStringList lines{headings.join(QLatin1Char(','))};
    for (int row = 0; row < model()->rowCount(); ++row) {
        QStringList fields;
        for (const QString &text : textsOf(row))
            fields << csvField(text);
        lines << fields.join(QLatin1Char(','));
    }
    return (lines.join(QLatin1Char('\n')) + QLatin1Char('\n')).toStdString();
}

void ColumnTable::copy() const
{
    QStringList lines;
    for (int row = 0; row < model()->rowCount(); ++row)
        if (selectionModel()->rowIntersectsSelection(row))
            lines << textsOf(row).join(QLatin1Char('\t'));
    QGuiApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

} // namespace faintline
