#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// A file's text of at most 64 MiB, as UTF-8 with lines that end in \n, from UTF-8 or UTF-16 with the line ends of any
/// system. Throws Error.
std::string readTableText(const std::string &path);

/// A table of text, read row by row, as spreadsheets and other programs write it: cells separated by tabs, semicolons or
/// commas (found from the first line, or named by a line "sep=;" before it), quoted or not, with decimal points or
/// commas. Errors name file and line.
class TextTable
{
public:
    /// `text` must outlive it. Without a header every line is a row, cells are separated by tabs and quotes are text.
    TextTable(std::string path, const std::string &text, bool hasHeader);

    const std::vector<std::string> &header() const { return m_header; }
    /// The column of a name, -1 if there is none.
    std::ptrdiff_t column(std::string_view name) const;
    std::ptrdiff_t neededColumn(std::string_view name) const;

    /// Goes to the next row that is not blank; false after the last.
    bool next();
    std::size_t size() const { return m_row.size(); }
    /// "FILE, line 3"
    std::string place() const;
    /// Empty if the row is too short or the column is -1.
    std::string cell(std::ptrdiff_t column) const;
    /// All numbers have the same decimal mark. `what` is for messages, such as "the begin".
    double number(std::ptrdiff_t column, const std::string &what);
    /// Nothing for an empty cell.
    std::optional<double> numberIfAny(std::ptrdiff_t column, const std::string &what);

private:
    bool nextLine(std::string &line);
    bool nextCells();
    std::vector<std::string> split(const std::string &line, bool &isOpen) const;

    std::string m_path;
    const std::string &m_text;
    std::size_t m_at = 0;
    std::size_t m_line = 0; ///< counted from 1
    char m_separator = '\t';
    bool m_hasQuotes = false;
    char m_decimalMark = 0; ///< as first seen
    std::vector<std::string> m_header;
    std::vector<std::string> m_row;
};

} // namespace faintline
