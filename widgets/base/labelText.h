#pragma once

#include "base/oneLine.h"

#include <QString>

#include <string>

class QLabel;

namespace faintline {

/// How text from files is shown. Names, units, notes and messages may hold anything: control characters, marks that
/// turn the direction of text, tags, a megabyte. A label gets one line of plain text of a known length.

/// As many letters of a file's name as a label shows.
constexpr int mostLabelLetters = 40;
/// As many of an axis's name or unit.
constexpr int mostUnitLetters = 24;
/// As many of a whole path as a tool tip shows, and of a note.
constexpr int longestPath = 1000;
constexpr int longestNote = 400;

/// On one line, without control characters and those of bidirectional text; of more than `mostLetters` the middle is
/// left out, "…".
QString labelText(const QString &text, int mostLetters = mostLabelLetters);
QString labelText(const std::string &text, int mostLetters = mostLabelLetters);

/// A message, of which every word that no line can hold is shortened in its middle.
QString messageText(const std::string &text, std::size_t mostBytes = longestMessage);

/// The same of as many lines as it has.
QString paragraphs(const std::string &text);

/// The same as a label for menus and buttons, where "&" makes the next letter a key.
QString buttonText(const QString &text, int mostLetters = mostLabelLetters);

/// Plain text for tool tips and message boxes, which take a text with tags for HTML: it is shown letter by letter, and
/// broken into lines.
QString asHtml(const QString &text);

/// A label that shows its text letter by letter, whatever tags are in it.
QLabel *plainLabel();

} // namespace faintline
