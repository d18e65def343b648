#include "widgets/base/labelText.h"

#include <QLabel>
#include <QRegularExpression>
#include <QScrollArea>
#include <QStringList>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    /// Removes an incomplete surrogate pair at the end.
    QString wholeCharacters(const QString &text)
    {
        return !text.isEmpty() && text.back().isHighSurrogate() ? text.chopped(1) : text;
    }

    QString wholeCharactersAtStart(const QString &text)
    {
        return !text.isEmpty() && text.front().isLowSurrogate() ? text.mid(1) : text;
    }

} // namespace

QString labelText(const std::string &text, int mostLetters)
{
    const QString line = QString::fromStdString(oneLine(text));
    if (line.size() <= mostLetters)
        return line;
    const int rest = mostLetters - 1;
    return wholeCharacters(line.left(rest - rest / 2)) + QStringLiteral("…")
           + wholeCharactersAtStart(line.right(rest / 2));
}

QString labelText(const QString &text, int mostLetters)
{
    return labelText(text.toStdString(), mostLetters);
}

QString messageText(const std::string &text, std::size_t mostBytes)
{
    const QString line = QString::fromStdString(oneLine(text, mostBytes));
    static const QRegularExpression longWord(QStringLiteral("[^ /]{%1,}").arg(mostLabelLetters + 1));
    QString shown;
    qsizetype end = 0;
    for (auto words = longWord.globalMatch(line); words.hasNext();) {
        const QRegularExpressionMatch word = words.next();
        shown += line.mid(end, word.capturedStart() - end) + labelText(word.captured());
        end = word.capturedEnd();
    }
    return shown + line.mid(end);
}

QString paragraphs(const std::string &text)
{
    QStringList lines;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines << messageText(text.substr(begin, end - begin), std::string::npos);
        begin = end + 1;
    }
    return lines.join(QLatin1Char('\n'));
}

QString buttonText(const QString &text, int mostLetters)
{
    return labelText(text, mostLetters).replace(QLatin1Char('&'), QLatin1String("&&"));
}

QString asHtml(const QString &text)
{
    return QStringLiteral("<qt>") + text.toHtmlEscaped() + QStringLiteral("</qt>");
}

QLabel *plainLabel()
{
    auto *label = new QLabel;
    label->setTextFormat(Qt::PlainText);
    return label;
}

QLabel *panelSentence()
{
    QLabel *label = plainLabel();
    label->setObjectName(QStringLiteral("sentence"));
    label->setWordWrap(true);
    return label;
}

QScrollArea *scrolledColumn(QWidget *column, Qt::ScrollBarPolicy sideways)
{
    auto *area = new QScrollArea;
    area->setWidget(column);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(sideways);
    return area;
}

void setScrolledColumn(QWidget &panel, QWidget *column, Qt::ScrollBarPolicy sideways)
{
    auto *layout = new QVBoxLayout(&panel);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scrolledColumn(column, sideways));
}

} // namespace faintline
