#include "app/lessons/LessonPanel.h"

#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QButtonGroup>
#include <QEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMouseEvent>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    constexpr int plainSize = 14;
    constexpr int largeSize = 26;      ///< readable from the last row
    constexpr int smallLargeSize = 15; ///< of a long step on a small screen, whose answers are to be seen at once

    /// A choice with wrapped text, all of which can be clicked; QRadioButton does not wrap.
    class ChoiceRow : public QWidget
    {
    public:
        explicit ChoiceRow(QRadioButton &button) : m_button(button) {}

    protected:
        void mousePressEvent(QMouseEvent *event) override { event->accept(); }
        void mouseReleaseEvent(QMouseEvent *event) override
        {
            if (event->button() == Qt::LeftButton && rect().contains(event->pos()))
                m_button.click();
        }

    private:
        QRadioButton &m_button;
    };

    QWidget *choiceRow(QRadioButton *button, QLabel *words)
    {
        auto *row = new ChoiceRow(*button);
        auto *layout = new QHBoxLayout(row);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(8);
        layout->addWidget(button, 0, Qt::AlignTop);
        layout->addWidget(words, 1);
        return row;
    }

} // namespace

LessonPanel::LessonPanel(QWidget *parent)
    : QWidget(parent), m_textSize(plainSize), m_title(plainLabel()), m_place(new QLabel), m_progress(new QProgressBar),
      m_area(new QScrollArea), m_back(new QPushButton(tr("Bac&k"))), m_next(new QPushButton(tr("Ne&xt"))),
      m_leave(new QPushButton(tr("Leave")))
{
    m_title->setWordWrap(true);
    m_progress->setTextVisible(false);
    m_progress->setFixedHeight(4);
    m_progress->setAccessibleName(tr("Progress of the lesson"));
    m_area->setWidgetResizable(true);
    m_area->setFrameShape(QFrame::NoFrame);
    m_area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_area->setAccessibleName(tr("The lesson's text"));
    m_area->installEventFilter(this);
    m_leave->setFlat(true);
    connect(m_back, &QPushButton::clicked, this, &LessonPanel::backRequested);
    connect(m_next, &QPushButton::clicked, this, &LessonPanel::nextRequested);
    connect(m_leave, &QPushButton::clicked, this, &LessonPanel::leaveRequested);

    auto *way = new QHBoxLayout;
    way->addWidget(m_leave);
    way->addStretch(1);
    way->addWidget(m_back);
    way->addWidget(m_next);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 8, 12, 8);
    layout->setSpacing(6);
    layout->addWidget(m_title);
    layout->addWidget(m_place);
    layout->addWidget(m_progress);
    layout->addWidget(m_area, 1);
    layout->addLayout(way);
}

QFont LessonPanel::font(bool isBold) const
{
    return isBold ? Theme::boldFont(m_textSize) : Theme::font(m_textSize);
}

QLabel *LessonPanel::paragraph(const QString &text, bool isBold)
{
    auto *label = new QLabel(text);
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    label->setFont(font(isBold));
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    label->setFocusPolicy(Qt::NoFocus);
    return label;
}

void LessonPanel::setStep(const Lesson &lesson, int step)
{
    m_lesson = lesson;
    m_step = step;
    m_isDone = m_isAtEnd = false;
    fill();
}

void LessonPanel::setEnd(const Lesson &lesson, const LessonAnswers &answers, const QString &next)
{
    m_lesson = lesson;
    m_answers = answers;
    m_following = next;
    m_isAtEnd = true;
    fillEnd();
}

void LessonPanel::setLarge(bool isLarge)
{
    constexpr int largeWidth = 500; // about thirty characters per line
    constexpr int mostPercent = 30; // of the window: on a small screen pictures and settings must fit beside it
    setMinimumWidth(isLarge ? std::min(largeWidth, window()->width() * mostPercent / 100) : 0);
    m_textSize = isLarge ? largeSize : plainSize;
    if (std::exchange(m_isLarge, isLarge) == isLarge || m_step < 0)
        return;
    if (m_isAtEnd)
        return fillEnd();
    const int chosen = choice();
    const bool wasDone = m_isDone;
    fill();
    m_isDone = wasDone;
    if (chosen >= 0) {
        const QSignalBlocker blocker(m_choices);
        m_choices->button(chosen)->setChecked(true);
        showAnswer(chosen);
    }
    showState();
    keepLatestInSight();
}

void LessonPanel::fillHead()
{
    m_title->setText(m_lesson.title);
    m_title->setFont(Theme::boldFont(m_textSize));
    m_place->setFont(Theme::font(m_isLarge ? 20 : 12));
    for (QPushButton *button : {m_back, m_next, m_leave})
        button->setFont(Theme::font(m_isLarge ? 20 : 13));
}

/// An empty page; `showPage` puts it in place of the present one.
QVBoxLayout *LessonPanel::newPage()
{
    m_choices = nullptr;
    m_words.clear();
    m_why = m_task = m_then = nullptr;
    m_learner = nullptr;
    m_save = nullptr;
    auto *page = new QWidget;
    auto *column = new QVBoxLayout(page);
    column->setContentsMargins(0, 4, 6, 4);
    column->setSpacing(m_isLarge ? 12 : 9);
    return column;
}

void LessonPanel::showPage(QVBoxLayout &column)
{
    column.addStretch(1);
    m_area->setWidget(column.parentWidget());
    m_area->verticalScrollBar()->setValue(0);
    fitText();
}

/// Of the page with text of that size, which it then has.
int LessonPanel::pageHeight(int textSize, int width)
{
    QWidget &page = *m_area->widget();
    m_textSize = textSize;
    for (QWidget *part : page.findChildren<QWidget *>()) {
        if (part->testAttribute(Qt::WA_SetFont))
            part->setFont(font(part->font().bold()));
        if (qobject_cast<QRadioButton *>(part))
            part->setFixedHeight(part->fontMetrics().height()); // beside the first line
        if (part->layout())
            part->layout()->invalidate();
        part->updateGeometry(); // what holds text remembers its height otherwise
    }
    page.layout()->invalidate();
    return page.layout()->totalHeightForWidth(width);
}

int LessonPanel::presentedHeight()
{
    if (!m_area->widget() || m_step < 0)
        return 0;
    const int before = m_textSize;
    const int smallest = pageHeight(smallLargeSize, m_area->maximumViewportSize().width());
    pageHeight(before, m_area->maximumViewportSize().width());
    return height() - m_area->height() + smallest;
}

/// In a presentation, the largest text with which the whole step is seen.
void LessonPanel::fitText()
{
    if (!m_isLarge || !m_area->widget() || !m_area->isVisible())
        return m_area->setVerticalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    const QSize room = m_area->maximumViewportSize();
    const int height = m_title->height() + room.height(); // which share the panel
    bool fits = false;
    for (int size = largeSize; size >= smallLargeSize && !fits; --size) {
        m_title->setFont(Theme::boldFont(size));
        fits = pageHeight(size, room.width()) + m_title->heightForWidth(m_title->width()) <= height;
    }
    // A bar that is there already makes the text too narrow to fit without one.
    m_area->setVerticalScrollBarPolicy(fits ? Qt::ScrollBarAlwaysOff : Qt::ScrollBarAsNeeded);
}

/// What was said last, and the task before it, once they have their place.
void LessonPanel::keepLatestInSight()
{
    QTimer::singleShot(0, m_area->widget(), [this] {
        fitText();
        for (QWidget *part : {m_task, m_why, m_then})
            if (part && !part->isHidden() && (part != m_then || m_isDone))
                m_area->ensureWidgetVisible(part);
    });
}

void LessonPanel::fill()
{
    const LessonStep &step = m_lesson.steps[std::size_t(m_step)];
    const int count = int(m_lesson.steps.size());
    fillHead();
    m_place->setText(tr("Step %1 of %2").arg(m_step + 1).arg(count));
    m_progress->setRange(0, count);
    m_progress->setValue(m_step + 1);
    m_next->setText(m_step + 1 == count ? tr("F&inish") : tr("Ne&xt"));
    m_next->show();
    m_leave->setText(tr("Leave"));
    m_back->setEnabled(m_step > 0);

    QVBoxLayout *column = newPage();
    column->addWidget(paragraph(step.title, true));
    column->addWidget(paragraph(step.text));
    if (step.question)
        fillQuestion(*step.question, *column);
    if (!step.task.isEmpty()) {
        m_task = paragraph({}, true);
        m_then = paragraph(step.then);
        column->addWidget(m_task);
        column->addWidget(m_then);
    }
    showState();
    showPage(*column);
}

void LessonPanel::fillQuestion(const LessonQuestion &question, QVBoxLayout &column)
{
    column.addWidget(paragraph(question.text, true));
    m_choices = new QButtonGroup(column.parentWidget());
    for (int i = 0; i < question.choices.size(); ++i) {
        auto *button = new QRadioButton;
        auto *words = paragraph(choiceText(i));
        words->setTextInteractionFlags(Qt::NoTextInteraction);
        words->setBuddy(button);
        button->setAccessibleName(question.choices[i]);
        button->setFont(font(false));
        button->setFixedHeight(button->fontMetrics().height()); // beside the first line
        m_choices->addButton(button, i);
        m_words.push_back(words);
        column.addWidget(choiceRow(button, words));
    }
    m_why = paragraph({});
    m_why->hide();
    column.addWidget(m_why);
    connect(m_choices, &QButtonGroup::idClicked, this, [this](int chosen) {
        showAnswer(chosen);
        emit answered(chosen);
    });
}

void LessonPanel::fillEnd()
{
    fillHead();
    m_place->setText(tr("Finished"));
    m_progress->setValue(m_progress->maximum());
    m_back->setEnabled(true);
    m_next->setText(tr("Ne&xt lesson"));
    m_next->setVisible(!m_following.isEmpty());
    m_next->setDefault(true);
    m_leave->setText(tr("Close"));

    QVBoxLayout *column = newPage();
    const auto [right, questions] = m_answers.questions(m_lesson);
    const auto [done, tasks] = m_answers.tasks(m_lesson);
    column->addWidget(paragraph(tr("End of the lesson"), true));
    if (questions > 0)
        column->addWidget(
            paragraph(tr("Questions answered right at the first choice: %1 of %2").arg(right).arg(questions)));
    if (tasks > 0)
        column->addWidget(paragraph(tr("Tasks done: %1 of %2").arg(done).arg(tasks)));
    if (!m_following.isEmpty())
        column->addWidget(paragraph(tr("Next lesson: %1").arg(m_following)));
    column->addWidget(paragraph(tr("To hand in your answers, enter your name and save them as a page.")));
    m_learner = new QLineEdit(m_learnerName);
    m_learner->setFont(font(false));
    m_learner->setMaxLength(200);
    m_learner->setPlaceholderText(tr("Your name"));
    m_learner->setAccessibleName(tr("Your name"));
    m_save = new QPushButton(tr("&Save answers…"));
    m_save->setFont(font(false));
    column->addWidget(m_learner);
    column->addWidget(m_save, 0, Qt::AlignLeft);
    showPage(*column);
    connect(m_learner, &QLineEdit::textChanged, this, [this](const QString &name) { m_learnerName = name; });
    connect(m_save, &QPushButton::clicked, this, [this] { emit saveRequested(m_learnerName); });
}

/// With its key, and once a choice is made, whether it was right.
QString LessonPanel::choiceText(int i) const
{
    const LessonQuestion &question = *m_lesson.steps[std::size_t(m_step)].question;
    const QString mark = choice() < 0           ? QString()
                         : i == question.answer ? QStringLiteral("✓ ")
                         : i == choice()        ? QStringLiteral("✗ ")
                                                : QString();
    return QStringLiteral("%1  ").arg(i + 1) + mark + question.choices[i];
}

void LessonPanel::takeKeys()
{
    m_area->setFocus(Qt::OtherFocusReason);
}

bool LessonPanel::chooseByKey(const QKeyEvent &key)
{
    const int i = key.key() - Qt::Key_1;
    const bool isPlain = !(key.modifiers() & ~Qt::KeypadModifier);
    QAbstractButton *button = m_choices && isPlain && isVisible() ? m_choices->button(i) : nullptr;
    if (button && !key.isAutoRepeat())
        button->click();
    return button;
}

int LessonPanel::choice() const
{
    return m_choices ? m_choices->checkedId() : -1;
}

void LessonPanel::showAnswer(int chosen)
{
    const LessonQuestion &question = *m_lesson.steps[std::size_t(m_step)].question;
    m_why->setText((chosen == question.answer
                        ? tr("Right. ")
                        : tr("Wrong. The answer is “%1”. ").arg(question.choices[question.answer]))
                   + question.why);
    m_why->show();
    showState();
    keepLatestInSight();
}

void LessonPanel::setDone(bool isDone)
{
    m_isDone = isDone;
    showState();
    if (isDone)
        keepLatestInSight();
}

void LessonPanel::setWaiting(bool isWaiting)
{
    m_isWaiting = isWaiting;
    showState();
}

void LessonPanel::showState()
{
    if (m_step < 0 || m_isAtEnd)
        return;
    const LessonStep &step = m_lesson.steps[std::size_t(m_step)];
    const Theme::Colours &colours = Theme::colours(*this);
    if (m_choices)
        for (QAbstractButton *button : m_choices->buttons()) {
            QPalette palette = this->palette();
            if (palette.color(QPalette::Window).lightness() < 128)
                palette.setColor(QPalette::Base,
                                 colours.frame.lighter(170)); // on a dark theme the button would be invisible
            button->setPalette(palette);
        }
    if (m_choices && choice() >= 0) {
        QPalette wrong = palette();
        wrong.setColor(QPalette::WindowText, colours.error);
        const bool isRight = choice() == step.question->answer;
        m_why->setPalette(isRight ? palette() : wrong);
        for (int i = 0; i < int(m_words.size()); ++i) {
            m_words[std::size_t(i)]->setText(choiceText(i));
            m_words[std::size_t(i)]->setPalette(i == choice() && !isRight ? wrong : palette());
        }
    }
    if (m_task) {
        m_task->setText((m_isDone ? QStringLiteral("✓ ") : QStringLiteral("→ ")) + step.task);
        QPalette palette = this->palette();
        palette.setColor(QPalette::WindowText, m_isDone ? colours.faintText : colours.accent);
        m_task->setPalette(palette);
        m_then->setVisible(m_isDone && !step.then.isEmpty());
    }
    m_place->setText(m_isWaiting ? tr("Step %1 of %2 · computing …").arg(m_step + 1).arg(m_lesson.steps.size())
                                 : tr("Step %1 of %2").arg(m_step + 1).arg(m_lesson.steps.size()));
    m_next->setDefault(step.task.isEmpty() || m_isDone);
}

QString LessonPanel::text() const
{
    QStringList all{m_title->text()};
    if (m_area->widget())
        for (const QLabel *label : m_area->widget()->findChildren<QLabel *>())
            if (!label->isHidden())
                all << label->text();
    return all.join(QLatin1Char('\n'));
}

bool LessonPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_area && (event->type() == QEvent::Resize || event->type() == QEvent::Show))
        QTimer::singleShot(0, this, &LessonPanel::fitText); // not while it is laid out
    return QWidget::eventFilter(watched, event);
}

void LessonPanel::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        showState();
}

} // namespace faintline
