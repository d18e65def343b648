#include "app/KeysOverlay.h"

#include "widgets/Theme.h"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <array>
#include <vector>

namespace faintline {

namespace {

    struct Entry {
        const char *keys;
        const char *does;
    };
    struct Section {
        const char *title;
        std::vector<Entry> entries;
    };

    const std::array<std::vector<Section>, 2> &columns()
    {
        static const std::array<std::vector<Section>, 2> all{{
            {{QT_TRANSLATE_NOOP("KeysOverlay", "Mouse on a waterfall"),
              {{"Wheel", "scroll time"},
               {"Shift + wheel", "scroll frequency"},
               {"Ctrl + wheel", "zoom about the pointer"},
               {"Wheel on an axis", "zoom that axis"},
               {"Drag", "pan"},
               {"Shift + drag", "zoom to a box"},
               {"Click", "place the cursor"},
               {"Double-click", "go to the event there"}}},
             {QT_TRANSLATE_NOOP("KeysOverlay", "Look"),
              {{"0", "show all"},
               {"Backspace", "zoom back"},
               {"Arrows", "move the cursor by a cell, with Ctrl by ten"},
               {"O", "next orientation"},
               {"C", "next colour map"},
               {"[  ]", "black level down, up"},
               {"{  }", "white level down, up"},
               {"A", "automatic range"}}}},
            {{QT_TRANSLATE_NOOP("KeysOverlay", "Detect"),
              {{",  .", "threshold down, up by a quarter nat"},
               {"N   Shift + N", "next, previous event"},
               {"W", "why detected, or why not"},
               {"M", "measure a box"},
               {"H", "harmonics of the cursor's frequency"},
               {"Space", "play"},
               {"J  L", "one frame back, forward; of a sequential test, a stage"},
               {"Ctrl + R", "run again"},
               {"Ctrl + B", "keep as A, to compare what comes after with"},
               {"Escape", "stop, or clear what is marked"}}},
             {QT_TRANSLATE_NOOP("KeysOverlay", "Sonar pings"),
              {{"P", "from above, or range over bearing"},
               {"J  L", "one ping back, forward"},
               {"Space   Shift + Space", "play, play backwards"},
               {"Ctrl + T", "state space under the cursor"}}},
             {QT_TRANSLATE_NOOP("KeysOverlay", "File"),
              {{"Ctrl + O", "open; or drop a file on the window"},
               {"Ctrl + S", "save the session"},
               {"Ctrl + Z   Ctrl + Y", "undo, redo a setting"},
               {"Ctrl + K", "find a command by name"},
               {"F1   ?", "these keys"},
               {"F5", "presentation"},
               {"Ctrl + Q", "quit"}}}},
        }};
        return all;
    }

    constexpr int rowHeight = 23;
    constexpr int titleHeight = 34;
    constexpr int keyWidth = 165;
    constexpr int columnWidth = 440;
    constexpr int margin = 28;

    int heightOf(const std::vector<Section> &sections)
    {
        int height = 0;
        for (const Section &section : sections)
            height += titleHeight + rowHeight * static_cast<int>(section.entries.size());
        return height;
    }

    void paintColumn(QPainter &painter, const std::vector<Section> &sections, QPoint at, const Theme::Colours &colours)
    {
        const auto tr = [](const char *text) { return QApplication::translate("KeysOverlay", text); };
        for (const Section &section : sections) {
            painter.setFont(Theme::boldFont(14));
            painter.setPen(colours.accent);
            painter.drawText(QRect(at, QSize(columnWidth, titleHeight)), Qt::AlignLeft | Qt::AlignVCenter,
                             tr(section.title));
            at.ry() += titleHeight;
            for (const Entry &entry : section.entries) {
                painter.setFont(Theme::boldFont());
                painter.setPen(colours.text);
                painter.drawText(QRect(at, QSize(keyWidth, rowHeight)), Qt::AlignLeft | Qt::AlignVCenter,
                                 tr(entry.keys));
                painter.setFont(Theme::font());
                painter.drawText(QRect(at.x() + keyWidth, at.y(), columnWidth - keyWidth, rowHeight),
                                 Qt::AlignLeft | Qt::AlignVCenter, tr(entry.does));
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

void KeysOverlay::toggle()
{
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
        event->accept(); // while the sheet is up, keys are for the sheet
    return QWidget::event(event);
}

void KeysOverlay::paintEvent(QPaintEvent *)
{
    const Theme::Colours &colours = Theme::colours(*this);
    const QSize size(2 * columnWidth + 3 * margin,
                     std::max(heightOf(columns()[0]), heightOf(columns()[1])) + 2 * margin);
    const QRect sheet(QPoint((width() - size.width()) / 2, (height() - size.height()) / 2), size);

    QPainter painter(this);
    painter.fillRect(rect(), QColor(0, 0, 0, 120));
    painter.fillRect(sheet, palette().color(QPalette::Window));
    painter.setPen(colours.frame);
    painter.drawRect(sheet.adjusted(0, 0, -1, -1));
    for (int i = 0; i < 2; ++i)
        paintColumn(painter, columns()[static_cast<std::size_t>(i)],
                    sheet.topLeft() + QPoint(margin + i * (columnWidth + margin), margin), colours);
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
