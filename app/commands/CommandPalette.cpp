#include "app/commands/CommandPalette.h"

#include "app/commands/keySections.h"

#include <QAction>
#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QRegularExpression>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    constexpr int paletteWidth = 520;
    constexpr int paletteHeight = 360;
    constexpr int bestOfLetters = 4; ///< score of a letter that begins a word

} // namespace

CommandPalette::CommandPalette(QWidget *window)
    : QFrame(window, Qt::Popup), m_line(new QLineEdit), m_list(new QListWidget)
{
    setObjectName(QStringLiteral("commandPalette"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    m_line->setPlaceholderText(tr("Type a command or setting"));
    m_line->setAccessibleName(tr("Command"));
    m_list->setAccessibleName(tr("Commands"));
    m_list->setFocusPolicy(Qt::NoFocus);
    m_list->setFrameShape(QFrame::NoFrame);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(m_line);
    layout->addWidget(m_list, 1);
    m_line->installEventFilter(this);
    connect(m_line, &QLineEdit::textChanged, this, &CommandPalette::filter);
    connect(m_line, &QLineEdit::returnPressed, this, &CommandPalette::carryOut);
    connect(m_list, &QListWidget::itemClicked, this, &CommandPalette::carryOut);
    hide();
}

void CommandPalette::open(const QList<QAction *> &commands)
{
    m_previousFocus = QApplication::focusWidget();
    m_commands.clear();
    collect(commands, {});
    const QPoint corner((parentWidget()->width() - paletteWidth) / 2, parentWidget()->height() / 8);
    setGeometry(QRect(parentWidget()->mapToGlobal(corner), QSize(paletteWidth, paletteHeight)));
    m_line->clear();
    filter({});
    show();
    raise();
    m_line->setFocus();
}

void CommandPalette::collect(const QList<QAction *> &actions, const QString &path)
{
    for (QAction *action : actions) {
        if (action->isSeparator() || !action->isVisible() || !action->isEnabled())
            continue;
        const QString name = path + plainText(*action);
        if (const QMenu *menu = action->menu())
            collect(menu->actions(), name + QStringLiteral(": "));
        else
            m_commands.append({name, action});
    }
}

int CommandPalette::match(const QString &name, const QString &typed)
{
    int score = 0;
    qsizetype last = -1;
    const QString letters = QString(typed).remove(QLatin1Char(' '));
    for (const QChar letter : letters) {
        const qsizetype at = name.indexOf(letter, last + 1, Qt::CaseInsensitive);
        if (at < 0)
            return -1;
        const bool beginsWord = at == 0 || !name[at - 1].isLetterOrNumber();
        score += beginsWord ? bestOfLetters : at == last + 1 ? 3 : 1;
        last = at;
    }
    const QRegularExpression asItStands(QStringLiteral("\\b") + QRegularExpression::escape(typed),
                                        QRegularExpression::CaseInsensitiveOption);
    return name.contains(asItStands) ? score + bestOfLetters * int(letters.size()) : score;
}

void CommandPalette::filter(const QString &typed)
{
    struct Found {
        int score;
        const Command *command;
    };
    QList<Found> found;
    for (const Command &command : m_commands)
        if (const int score = match(command.name, typed.simplified()); score >= 0)
            found.append({score, &command});
    const auto rank = [&](const Found &one) { // among equals the name with least else in it
        return std::pair(-one.score, typed.isEmpty() ? qsizetype(0) : one.command->name.size());
    };
    std::stable_sort(found.begin(), found.end(), [&](const Found &a, const Found &b) { return rank(a) < rank(b); });
    m_list->clear();
    for (const Found &each : found) {
        const QString key = each.command->action->shortcut().toString(QKeySequence::NativeText);
        auto *item = new QListWidgetItem(
            key.isEmpty() ? each.command->name : each.command->name + QStringLiteral("   (") + key + QLatin1Char(')'));
        item->setData(Qt::UserRole, static_cast<qlonglong>(each.command - m_commands.constData()));
        m_list->addItem(item);
    }
    m_list->setCurrentRow(0);
}

void CommandPalette::carryOut()
{
    const QListWidgetItem *item = m_list->currentItem();
    if (!item)
        return;
    QAction *action = m_commands[item->data(Qt::UserRole).toLongLong()].action;
    hide();
    giveFocusBack();
    action->trigger();
}

void CommandPalette::giveFocusBack()
{
    (m_previousFocus ? m_previousFocus.data() : parentWidget())->setFocus();
}

bool CommandPalette::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::FocusOut)
        hide();
    if (event->type() == QEvent::ShortcutOverride)
        event->accept(); // letters belong to the input line, not to the window's single-key shortcuts
    if (event->type() != QEvent::KeyPress)
        return QFrame::eventFilter(watched, event);
    const int key = static_cast<QKeyEvent *>(event)->key();
    if (key == Qt::Key_Escape) {
        hide();
        giveFocusBack();
        return true;
    }
    if (key == Qt::Key_Down || key == Qt::Key_Up) {
        const int row = m_list->currentRow() + (key == Qt::Key_Down ? 1 : -1);
        m_list->setCurrentRow(std::clamp(row, 0, m_list->count() - 1));
        return true;
    }
    return QFrame::eventFilter(watched, event);
}

} // namespace faintline
