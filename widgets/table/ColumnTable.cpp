#include "widgets/table/ColumnTable.h"

#include "widgets/base/Theme.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// A text with its numbers as programs read them: "−3·10⁻²⁵" as "-3e-25".
    QString plainText(QString text)
    {
        static const QString superscripts = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹⁻");
        text.replace(QChar(0x2212), QLatin1Char('-'));
        const QString ten = QStringLiteral("·10");
        for (auto at = text.indexOf(ten); at >= 0; at = text.indexOf(ten, at + 1)) {
            text.replace(at, ten.size(), QLatin1Char('e'));
            for (auto i = at + 1; i < text.size() && superscripts.contains(text[i]); ++i) {
                const auto digit = superscripts.indexOf(text[i]);
                text[i] = digit < 10 ? QChar('0' + int(digit)) : QLatin1Char('-');
            }
        }
        return text;
    }

    QString csvField(QString text)
    {
        const bool isPlain = std::ranges::none_of(text, [](QChar c) { return c == ',' || c == '"' || c == '\n'; });
        return isPlain ? text : QLatin1Char('"') + text.replace('"', QLatin1String("\"\"")) + QLatin1Char('"');
    }

} // namespace

ColumnTable::ColumnTable(const QString &accessibleName, ColumnModel *model, ColumnProxy *proxy)
    : m_model(model ? model : new ColumnModel(this)), m_proxy(proxy ? proxy : new ColumnProxy(this))
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
    m_proxy->setSortRole(ColumnModel::SortRole);
    m_proxy->setDynamicSortFilter(false); // a row stays where it is when it changes
    m_proxy->setSourceModel(m_model);
    setModel(m_proxy);

    // Only a table that is sorted has an arrow, for which all its headings keep room.
    horizontalHeader()->setSortIndicatorClearable(true);
    connect(horizontalHeader(), &QHeaderView::sectionClicked, this, [this](int column) {
        if (isSortingEnabled())
            return;
        setSortingEnabled(true);
        sortByColumn(column, Qt::AscendingOrder);
    });
    connect(horizontalHeader(), &QHeaderView::sortIndicatorChanged, this, [this](int column) {
        if (column >= 0 && horizontalHeader()->sectionResizeMode(column) == QHeaderView::Interactive)
            setColumnWidth(column, std::max(columnWidth(column), headingWidth(column)));
    });
    auto *copying = new QAction(tr("Copy"), this);
    copying->setShortcut(QKeySequence::Copy);
    copying->setShortcutContext(Qt::WidgetShortcut);
    connect(copying, &QAction::triggered, this, &ColumnTable::copy);
    addAction(copying);
    setWordWrap(false);
    setContextMenuPolicy(Qt::ActionsContextMenu);
}

bool ColumnProxy::lessThan(const QModelIndex &left, const QModelIndex &right) const
{
    const auto isBlank = [](const QModelIndex &index) {
        const QVariant key = index.data(ColumnModel::SortRole);
        return key.typeId() == QMetaType::Double && std::isnan(key.toDouble());
    };
    if (isBlank(left) || isBlank(right)) // last in both orders
        return isBlank(left) != isBlank(right) && isBlank(right) == (sortOrder() == Qt::AscendingOrder);
    return QSortFilterProxyModel::lessThan(left, right);
}

void ColumnTable::setSmall(int rowHeight)
{
    verticalHeader()->setDefaultSectionSize(rowHeight);
    setFont(Theme::font(12));
    horizontalHeader()->setFont(Theme::font(12));
    horizontalHeader()->setMinimumSectionSize(24);
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

int ColumnTable::headingWidth(int column) const
{
    constexpr int room = 6, arrow = 12; // pixels, without the style's margins
    const QHeaderView &header = *horizontalHeader();
    return header.fontMetrics().horizontalAdvance(model()->headerData(column, Qt::Horizontal).toString()) + room
           + (header.sortIndicatorSection() == column ? arrow : 0);
}

QList<int> ColumnTable::shownColumns() const
{
    QList<int> columns;
    for (int place = 0; place < horizontalHeader()->count(); ++place)
        if (const int column = horizontalHeader()->logicalIndex(place); !isColumnHidden(column))
            columns << column;
    return columns;
}

QString ColumnTable::textOf(int row, int column) const
{
    return plainText(model()->index(row, column).data().toString());
}

std::string ColumnTable::csv() const
{
    QStringList headings;
    for (const int column : shownColumns())
        headings << csvField(model()->headerData(column, Qt::Horizontal).toString());
    QStringList lines{headings.join(QLatin1Char(','))};
    for (int row = 0; row < model()->rowCount(); ++row) {
        QStringList fields;
        for (const int column : shownColumns())
            fields << csvField(textOf(row, column));
        lines << fields.join(QLatin1Char(','));
    }
    return (lines.join(QLatin1Char('\n')) + QLatin1Char('\n')).toStdString();
}

void ColumnTable::copy() const
{
    QStringList lines;
    for (int row = 0; row < model()->rowCount(); ++row) {
        QStringList texts;
        for (const int column : shownColumns())
            if (selectionModel()->isSelected(model()->index(row, column)))
                texts << textOf(row, column);
        if (!texts.isEmpty())
            lines << texts.join(QLatin1Char('\t'));
    }
    if (!lines.isEmpty())
        QGuiApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

} // namespace faintline
