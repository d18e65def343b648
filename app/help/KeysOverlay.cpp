#include "app/help/KeysOverlay.h"

#include "app/help/keySections.h"
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
    constexpr int gap = 14; ///< between the view's keys and the others

    /// Of a column, in which no text is cut.
    struct ColumnWidths {
        int keys = 150;
        int words = 0;

        int all() const { return keys + words; }
        void include(const std::vector<KeySection> &sections)
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

void KeysOverlay::toggle(const QString &view)
{
    m_view = view;
    if (isVisible())
        return close();
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
    const Theme::Colours &colours = Theme::colours(*this);
    // The keys of the view are above, in two halves; those valid everywhere are below.
    const KeySection own = keysOfView(m_view);
    const auto rows = std::ptrdiff_t(own.entries.size() + 1) / 2;
    const KeySection halves[2]{{own.title, {own.entries.begin(), own.entries.begin() + rows}},
                               {QString(), {own.entries.begin() + rows, own.entries.end()}}};
    const int ownHeight = own.entries.empty() ? 0 : heightOf({halves[0]}) + gap;
    const auto general = generalKeys(m_view);
    ColumnWidths widths;
    for (int i = 0; i < 2; ++i) {
        widths.include({halves[i]});
        widths.include(general[std::size_t(i)]);
    }
    const QRect sheet(QPoint(),
                      QSize(2 * widths.all() + 3 * sheetMargin,
                            ownHeight + std::max(heightOf(general[0]), heightOf(general[1])) + 2 * sheetMargin));

    QPainter painter(this);
    painter.fillRect(rect(), QColor(0, 0, 0, 120));
    const double scale = std::min({1.0, double(width()) / sheet.width(), double(height()) / sheet.height()});
    painter.translate(0.5 * (width() - scale * sheet.width()), 0.5 * (height() - scale * sheet.height()));
    painter.scale(scale, scale); // on a small screen
    painter.fillRect(sheet, palette().color(QPalette::Window));
    painter.setPen(colours.frame);
    painter.drawRect(sheet.adjusted(0, 0, -1, -1));
    for (int i = 0; i < 2; ++i) {
        const QPoint column = sheet.topLeft() + QPoint(sheetMargin + i * (widths.all() + sheetMargin), sheetMargin);
        if (ownHeight > 0)
            paintColumn(painter, {halves[i]}, column, widths, colours);
        paintColumn(painter, general[std::size_t(i)], column + QPoint(0, ownHeight), widths, colours);
    }
    if (ownHeight > 0) {
        painter.setPen(colours.frame);
        painter.drawLine(sheet.left() + sheetMargin, sheet.top() + sheetMargin + ownHeight - gap / 2,
                         sheet.right() - sheetMargin, sheet.top() + sheetMargin + ownHeight - gap / 2);
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
