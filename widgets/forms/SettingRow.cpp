#include "widgets/forms/SettingRow.h"

#include "base/Error.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/fractionText.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace faintline {

namespace {

    QString shownText(const FieldValue &value)
    {
        return fractionText(value);
    }

    QString wordFor(const FieldInfo &info, const FieldValue &value)
    {
        return QString::fromStdString(wordOf(info, value));
    }

    QString shownText(const FieldInfo &info, const FieldValue &value)
    {
        const QString word = wordFor(info, value);
        return word.isEmpty() ? shownText(value) : word;
    }

    QString orWords(const FieldInfo &info)
    {
        QString text;
        for (const ValueWord &one : info.words)
            text += SettingRow::tr(", or “%1”").arg(QString::fromStdString(one.word));
        return text;
    }

    /// The sentence, followed by the accepted range, the default and the advice.
    QString toolTipOf(const FieldInfo &info, const FieldValue &defaultValue)
    {
        const QString unit = info.unit.empty() ? QString() : QStringLiteral(" ") + QString::fromStdString(info.unit);
        QStringList lines{QString::fromStdString(info.sentence).toHtmlEscaped()};
        if (info.kind == FieldKind::Integer || info.kind == FieldKind::Number || info.kind == FieldKind::Numbers)
            lines << SettingRow::tr("Range: %1 … %2%3")
                             .arg(QString::fromStdString(formatNumber(info.minimum)),
                                  QString::fromStdString(formatNumber(info.maximum)), unit)
                         + orWords(info);
        const QString defaultText =
            info.kind == FieldKind::Choice
                ? choiceLabel(info, shownText(defaultValue))
                : shownText(info, defaultValue) + (wordFor(info, defaultValue).isEmpty() ? unit : QString());
        lines << SettingRow::tr("Default: %1")
                     .arg(info.kind == FieldKind::Flag
                              ? (std::get<bool>(defaultValue) ? SettingRow::tr("on") : SettingRow::tr("off"))
                              : defaultText.toHtmlEscaped());
        if (!info.advice.empty())
            lines << QString::fromStdString(info.advice).toHtmlEscaped();
        lines << QStringLiteral("<small>%1</small>").arg(QString::fromStdString(info.name));
        return QStringLiteral("<qt>%1</qt>").arg(lines.join(QStringLiteral("<br>")));
    }

    /// Whether a comma may separate thousands as well as decimals: "48,000", but not "0,125".
    bool hasThousands(const QString &text)
    {
        static const QRegularExpression thousands(QStringLiteral("^[+-]?[1-9][0-9]{0,2},[0-9]{3}$"));
        return thousands.match(text).hasMatch();
    }

    /// Whether a text is a number, or a word for one, in range or not.
    bool isNumber(FieldInfo info, const QString &text)
    {
        info.minimum = std::numeric_limits<double>::lowest();
        info.maximum = std::numeric_limits<double>::max();
        try {
            parseFieldValue(info, text.toStdString());
            return true;
        } catch (const Error &) {
            return false;
        }
    }

    /// Choices and lists need the width of the form and are placed below their label.
    bool isBelowLabel(const FieldInfo &info)
    {
        return info.kind == FieldKind::Choice || info.kind == FieldKind::Numbers;
    }

    /// A long unit would leave no room for the field and is placed with the label.
    bool isWithLabel(const std::string &unit)
    {
        constexpr std::size_t longest = 5;
        return unit.size() > longest;
    }

    /// A text field with arrows whose steps are defined elsewhere.
    class ArrowBox : public QAbstractSpinBox
    {
    public:
        explicit ArrowBox(std::function<void(int)> step) : m_step(std::move(step)) {}
        void stepBy(int steps) override { m_step(steps); }
        QLineEdit *line() const { return lineEdit(); }

    protected:
        StepEnabled stepEnabled() const override { return StepUpEnabled | StepDownEnabled; }

    private:
        std::function<void(int)> m_step;
    };

} // namespace

SettingRow::SettingRow(const FieldInfo &info, const FieldValue &defaultValue, double stepsInOne, QWidget *parent)
    : QWidget(parent), m_info(info), m_default(defaultValue), m_value(defaultValue), m_stepsInOne(stepsInOne),
      m_label(new QLabel(QString::fromStdString(labelOf(info)))),
      m_unit(new QLabel(QString::fromStdString(info.unit), this)), m_reset(new QToolButton), m_message(plainLabel())
{
    makeEditor();
    const QString label = m_label->text();
    const QString toolTip = toolTipOf(info, defaultValue);
    for (QWidget *widget : {static_cast<QWidget *>(m_label), m_editor})
        widget->setToolTip(toolTip);
    m_label->setBuddy(m_editor);
    m_label->setWordWrap(true);
    m_editor->setAccessibleName(info.unit.empty() ? label
                                                  : tr("%1 in %2").arg(label, QString::fromStdString(info.unit)));
    m_editor->setAccessibleDescription(QString::fromStdString(info.sentence));
    m_editor->setObjectName(QString::fromStdString(info.name));

    m_unit->setFont(Theme::font(12));
    m_unit->setHidden(info.unit.empty());
    m_unit->setForegroundRole(QPalette::PlaceholderText);
    m_reset->setText(QStringLiteral("↺"));
    m_reset->setAutoRaise(true);
    m_reset->setFixedSize(18, 20);
    m_reset->setToolTip(tr("Reset to the default"));
    m_reset->setAccessibleName(tr("Reset %1 to its default").arg(label));
    QSizePolicy keepsPlace = m_reset->sizePolicy();
    keepsPlace.setRetainSizeWhenHidden(true);
    m_reset->setSizePolicy(keepsPlace);
    connect(m_reset, &QToolButton::clicked, this, [this] { accept(m_default); });

    auto *grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(5);
    grid->setVerticalSpacing(1);
    const bool isBelow = isBelowLabel(info);
    grid->addWidget(m_label, 0, 0);
    if (!info.unit.empty() && isWithLabel(info.unit)) {
        m_unit->setContentsMargins(0, 0, 0, 2);
        grid->addWidget(m_unit, 1, 0);
        grid->addWidget(m_editor, 0, 1, 2, 1);
    } else {
        auto *line = new QHBoxLayout;
        line->setSpacing(5);
        line->addWidget(m_editor, 1);
        if (!info.unit.empty())
            line->addWidget(m_unit);
        grid->addLayout(line, isBelow ? 1 : 0, isBelow ? 0 : 1, 1, isBelow ? 2 : 1);
    }
    grid->addWidget(m_reset, isBelow ? 1 : 0, 2);
    grid->addWidget(m_message, 2, 0, 1, 3);
    grid->setColumnStretch(1, 1);
    m_message->setWordWrap(true);
    m_message->setFont(Theme::font(12));
    setValue(defaultValue);
}

void SettingRow::setUnit(const QString &unit, double largestMagnitude)
{
    m_info.unit = unit.toStdString();
    m_info.minimum = -largestMagnitude;
    m_info.maximum = largestMagnitude;
    for (QWidget *widget : {static_cast<QWidget *>(m_label), m_editor})
        widget->setToolTip(toolTipOf(m_info, m_default));
    m_unit->setText(unit);
    m_editor->setAccessibleName(tr("%1 in %2").arg(m_label->text(), unit));
}

void SettingRow::setTracking(bool isOn)
{
    m_isTracking = isOn;
    if (auto *box = qobject_cast<QSpinBox *>(m_editor))
        box->setKeyboardTracking(isOn);
}

void SettingRow::setLabelWidth(int width)
{
    if (!isBelowLabel(m_info))
        m_label->setFixedWidth(width);
}

void SettingRow::makeEditor()
{
    switch (m_info.kind) {
    case FieldKind::Flag: {
        auto *box = new QCheckBox;
        connect(box, &QCheckBox::toggled, this, [this](bool isOn) { accept(isOn); });
        m_editor = box;
        break;
    }
    case FieldKind::Choice: {
        auto *box = new QComboBox;
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(6);
        for (const std::string &choice : m_info.choices)
            box->addItem(choiceLabel(m_info, QString::fromStdString(choice)), QString::fromStdString(choice));
        connect(box, &QComboBox::activated, this, [this, box] { accept(box->currentData().toString().toStdString()); });
        m_editor = box;
        break;
    }
    case FieldKind::Integer: {
        auto *box = new QSpinBox;
        box->setRange(int(m_info.minimum), int(m_info.maximum));
        box->setKeyboardTracking(false);
        connect(box, &QSpinBox::valueChanged, this, [this](int value) { accept(value); });
        m_editor = box;
        break;
    }
    case FieldKind::Number:
    case FieldKind::Numbers: {
        if (m_stepsInOne > 0) {
            auto *box = new ArrowBox([this](int steps) { stepBy(steps); });
            connect(box, &QAbstractSpinBox::editingFinished, this, [this, box] {
                // Return clears the line edit's own modified flag; after an error the old value also counts.
                if (box->text() != shownText(m_value) || m_isRefused)
                    acceptText(box->text());
            });
            m_editor = box;
            break;
        }
        auto *edit = new QLineEdit;
        edit->setPlaceholderText(QString::fromStdString(m_info.example));
        connect(edit, &QLineEdit::editingFinished, this, [this, edit] {
            if (edit->isModified())
                acceptText(edit->text());
        });
        connect(edit, &QLineEdit::textEdited, this, [this](const QString &text) {
            if (!m_isTracking)
                return;
            const QScopedValueRollback typing(m_isTyping, true);
            acceptText(text);
        });
        m_editor = edit;
        break;
    }
    }
    m_editor->setMinimumWidth(56);
    m_editor->setFocusPolicy(Qt::StrongFocus);
    m_editor->installEventFilter(this);
}

void SettingRow::acceptText(const QString &text)
{
    QString plain = text.trimmed().replace(QChar(0x2212), QLatin1Char('-'));
    if (m_info.kind == FieldKind::Number) {
        if (hasThousands(plain))
            return refuse(tr("is ambiguous: write %1 or %2")
                              .arg(QString(plain).remove(QLatin1Char(',')),
                                   QString(plain).replace(QLatin1Char(','), QLatin1Char('.'))));
        plain.replace(QLatin1Char(','), QLatin1Char('.')); // a decimal one; in a list it separates
        if (!isNumber(m_info, plain))
            return refuse(tr("must be a number%1").arg(orWords(m_info)));
    }
    try {
        accept(parseFieldValue(m_info, plain.toStdString()));
    } catch (const Error &error) {
        refuse(QString::fromStdString(error.why()));
    }
}

void SettingRow::refuse(const QString &why)
{
    setError(why);
    m_isRefused = true;
    emit refusalChanged();
}

/// Steps to the next multiples of a step, which are integers over `m_stepsInOne`.
void SettingRow::stepBy(int steps)
{
    if (const QString typed = static_cast<ArrowBox *>(m_editor)->text(); typed != shownText(m_value))
        acceptText(typed);
    constexpr double isMultiple = 1e-6;
    const double at = std::get<double>(m_value) * m_stepsInOne;
    const double from = steps > 0 ? std::floor(at + isMultiple) : std::ceil(at - isMultiple);
    constexpr double digits = 1e4; // for steps that are not fractions of integers, such as those in Hz/s
    const double next = (from + steps) / m_stepsInOne;
    const bool isWhole = m_stepsInOne == std::floor(m_stepsInOne);
    accept(std::clamp(isWhole ? next : std::round(next * digits) / digits, m_info.minimum, m_info.maximum));
}

void SettingRow::accept(const FieldValue &value)
{
    const bool isSame = value == m_value;
    const bool wasRefused = m_isRefused;
    setError(QString());
    setValue(value);
    if (!isSame)
        emit edited(value);
    if (wasRefused)
        emit refusalChanged();
}

void SettingRow::setValue(const FieldValue &value)
{
    m_value = value;
    m_isRefused = false;
    const QSignalBlocker blocker(m_editor);
    if (auto *box = qobject_cast<QCheckBox *>(m_editor))
        box->setChecked(std::get<bool>(value));
    else if (auto *choice = qobject_cast<QComboBox *>(m_editor))
        choice->setCurrentIndex(choice->findData(shownText(value)));
    else if (auto *spin = qobject_cast<QSpinBox *>(m_editor))
        spin->setValue(std::get<int>(value));
    else if (auto *arrows = qobject_cast<QAbstractSpinBox *>(m_editor))
        static_cast<ArrowBox *>(arrows)->line()->setText(shownText(value));
    else if (auto *edit = qobject_cast<QLineEdit *>(m_editor)) {
        if (!m_isTyping) {
            edit->setText(shownText(m_info, value));
            edit->setCursorPosition(0);
        }
        m_unit->setVisible(!m_info.unit.empty() && wordFor(m_info, value).isEmpty());
    }
    m_reset->setVisible(value != m_default);
    const int size = m_label->font().pixelSize(); // larger in presentations
    m_label->setFont(value == m_default ? Theme::font(size) : Theme::boldFont(size));
}

void SettingRow::setError(const QString &sentence)
{
    m_error = sentence;
    showMessage();
}

void SettingRow::setNote(const QString &note)
{
    m_note = note;
    showMessage();
}

void SettingRow::showMessage()
{
    const Theme::Colours &colours = Theme::colours(*this);
    QPalette message = m_message->palette();
    message.setColor(QPalette::WindowText, m_error.isEmpty() ? colours.faintText : colours.error);
    m_message->setPalette(message);
    m_message->setText(m_error.isEmpty() ? m_note : m_error);
    m_message->setVisible(!m_message->text().isEmpty());
    QPalette field;
    if (!m_error.isEmpty()) {
        field = palette();
        field.setColor(QPalette::Text, colours.error);
    }
    m_editor->setPalette(field);
}

bool SettingRow::eventFilter(QObject *watched, QEvent *event)
{
    // A wheel over a form scrolls the form and never changes a setting.
    if (watched == m_editor && event->type() == QEvent::Wheel && !m_editor->hasFocus()) {
        event->ignore();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void SettingRow::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        showMessage();
}

} // namespace faintline
