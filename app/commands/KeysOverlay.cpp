#include "app/commands/KeysOverlay.h"

#include "widgets/base/Theme.h"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <vector>

namespace faintline {

namespace {

    constexpr int rowHeight = 23;
    constexpr int titleHeight = 34;
    constexpr int sheetMargin = 28;
    constexpr int columnCount = 3;

    /// Of a column, in which no text is cut.
    struct ColumnWidths {
        int keys = 0;
        int words = 0;

        int all() const { return keys + words; }
        explicit ColumnWidths(const std::vector<KeySection> &sections)
        {
            constexpr int room = 12; // behind a text
            const QFontMetrics bold(Theme::boldFont());
            const QFontMetrics plain(Theme::font());
            for (const KeySection &section : sections)
                for (const KeySection::Entry &entry : section.entries) {
                    keys = std::max(keys, bold.horizontalAdvance(entry.keys) + room);
                    words = std::max(words, plain.horizontalAdvance(entry.does) + room);
                }
        }
    };

    int heightOf(const std::vector<KeySection> &sections)
    {
        int height = 0;
        for (const KeySection &section : sections)
            height += titleHeight + rowHeight * int(section.entries.size());
        return height;
    }

    /// About equally high.
    std::vector<std::vector<KeySection>> inColumns(const std::vector<KeySection> &sections)
    {
        std::vector<std::vector<KeySection>> columns(columnCount);
        for (const KeySection &section : sections)
            std::ranges::min_element(columns, {}, heightOf)->push_back(section);
        return columns;
    }

    void paintColumn(QPainter &painter, const std::vector<KeySection> &sections, QPoint at, const ColumnWidths &widths,
                     const Theme::Colours &colours)
    {
        for (const KeySection &section : sections) {
            painter.setFont(Theme::boldFont(14));
            painter.setPen(colours.accent);
            painter.drawText(QRect(at, QSize(widths.all(), titleHeight)), Qt::AlignLeft | Qt::AlignVCenter,
                             section.title);
            at.ry() += titleHeight;
            for (const KeySection::Entry &entry : section.entries) {
                painter.setFont(Theme::boldFont());
                painter.setPen(colours.text);
                painter.drawText(QRect(at, QSize(widths.keys, rowHeight)), Qt::AlignLeft | Qt::AlignVCenter,
                                 entry.keys);
                painter.setFont(Theme::font());
                painter.drawText(QRect(at.x() + widths.keys, at.y(), widths.words, rowHeight),
                                 Qt::AlignLeft | Qt::AlignVCenter, entry.does);
                at.ry() += rowHeight;
            }
        }
    }

} // namespace

KeysOverlay::KeysOverlay(QWidget *window) : QWidget(window)
{
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Keys and mouse"));
    window->installEventFilter(this);
    hide();
}

void KeysOverlay::toggle(const QString &view, const QList<QAction *> &menus)
{
    if (isVisible())
        return close();
    m_sections = generalKeys(view, menus);
    if (KeySection own = keysOfView(view); !own.entries.empty())
        m_sections.insert(m_sections.begin(), std::move(own));
    m_previousFocus = QApplication::focusWidget();
    setGeometry(parentWidget()->rect());
    raise();
    show();
    setFocus();
}

void KeysOverlay::close()
{
    hide();
    if (m_previousFocus)
        m_previousFocus->setFocus();
}

bool KeysOverlay::event(QEvent *event)
{
    if (event->type() == QEvent::ShortcutOverride)
        event->accept(); // keys apply to the sheet while it is open
    return QWidget::event(event);
}

void KeysOverlay::paintEvent(QPaintEvent *)
{
    const auto columns = inColumns(m_sections);
    int sheetWidth = sheetMargin, sheetHeight = 0;
    std::vector<ColumnWidths> widths;
    for (const std::vector<KeySection> &column : columns) {
        widths.emplace_back(column);
        sheetWidth += widths.back().all() + sheetMargin;
        sheetHeight = std::max(sheetHeight, heightOf(column) + 2 * sheetMargin);
    }
    QPainter painter(this);
    painter.fillRect(rect(), QColor(0, 0, 0, 120));
    const double scale = std::min({1.0, double(width()) / sheetWidth, double(height()) / sheetHeight});
    painter.translate(0.5 * (width() - scale * sheetWidth), 0.5 * (height() - scale * sheetHeight));
    painter.scale(scale, scale); // on a small screen
    painter.fillRect(0, 0, sheetWidth, sheetHeight, palette().color(QPalette::Window));
    painter.setPen(Theme::colours(*this).frame);
    painter.drawRect(0, 0, sheetWidth - 1, sheetHeight - 1);
    QPoint at(sheetMargin, sheetMargin);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        paintColumn(painter, columns[i], at, widths[i], Theme::colours(*this));
        at.rx() += widths[i].all() + sheetMargin;
    }
}

void KeysOverlay::keyPressEvent(QKeyEvent *)
{
    close();
}

void KeysOverlay::mousePressEvent(QMouseEvent *)
{
    close();
}

bool KeysOverlay::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == parentWidget() && event->type() == QEvent::Resize)
        setGeometry(parentWidget()->rect());
    return QWidget::eventFilter(watched, event);
}

} // namespace faintline
