#pragma once

#include "base/oneLine.h"

#include <QString>

#include <string>

class QLabel;
class QScrollArea;
class QWidget;

namespace faintline {

/// Display of text from files. Names, units, notes and messages may contain control characters, bidirectional marks,
/// tags, or a megabyte of text. A label gets one line of plain text of limited length.

/// Maximum length of a file name in a label.
constexpr int mostLabelLetters = 40;
/// Maximum length of an axis's name or unit.
constexpr int mostUnitLetters = 24;
/// Maximum lengths of a path in a tool tip, and of a note.
constexpr int longestPath = 1000;
constexpr int longestNote = 400;

/// One line without control and bidirectional characters. If it is longer than `mostLetters`, its middle is replaced by
/// "…".
QString labelText(const QString &text, int mostLetters = mostLabelLetters);
QString labelText(const std::string &text, int mostLetters = mostLabelLetters);

/// A message in which words too long for a line are shortened in their middle.
QString messageText(const std::string &text, std::size_t mostBytes = longestMessage);

/// The same for a text of several lines.
QString paragraphs(const std::string &text);

/// The same for menus and buttons, with "&" escaped.
QString buttonText(const QString &text, int mostLetters = mostLabelLetters);

/// Escapes plain text for tool tips and message boxes, which interpret tags as HTML, and breaks it into lines.
QString asHtml(const QString &text);

/// A label that shows its text literally, including tags.
QLabel *plainLabel();
/// The same for sentences; its name is "sentence".
QLabel *panelSentence();

/// An area in which a column is scrolled where it is too long.
QScrollArea *scrolledColumn(QWidget *column, Qt::ScrollBarPolicy sideways = Qt::ScrollBarAlwaysOff);
/// Fills a panel with one.
void setScrolledColumn(QWidget &panel, QWidget *column, Qt::ScrollBarPolicy sideways = Qt::ScrollBarAlwaysOff);

} // namespace faintline
