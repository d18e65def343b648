#include "exchange/textTable.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace faintline {

namespace {

    void appendUtf8(std::string &text, char32_t c)
    {
        if (c < 0x80)
            return text.push_back(char(c));
        const int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
        constexpr unsigned char leads[]{0, 0xc0, 0xe0, 0xf0};
        text.push_back(char(leads[more] | (c >> (6 * more))));
        for (int shift = 6 * (more - 1); shift >= 0; shift -= 6)
            text.push_back(char(0x80 | ((c >> shift) & 0x3f)));
    }

    /// UTF-16 with the byte of weight 256 at `high` (0 or 1) of each pair; unpaired surrogates become U+FFFD.
    std::string fromUtf16(std::string_view bytes, std::size_t high)
    {
        const auto unit = [&](std::size_t i) {
            return i + 1 < bytes.size() ? char32_t((static_cast<unsigned char>(bytes[i + high]) << 8)
                                                   | static_cast<unsigned char>(bytes[i + 1 - high]))
                                        : char32_t(0);
        };
        std::string text;
        for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
            char32_t c = unit(i);
            if (c >= 0xd800 && c < 0xdc00 && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000) {
                c = 0x10000 + ((c - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
                i += 2;
            } else if (c >= 0xd800 && c < 0xe000) {
                c = 0xfffd;
            }
            appendUtf8(text, c);
        }
        return text;
    }

    /// Without a byte order mark, UTF-16 of a table is known by the zero in its first character, which is no letter's.
    std::string inUtf8(std::string text)
    {
        const std::string_view all = text;
        if (all.starts_with("\xef\xbb\xbf"))
            return text.substr(3);
        if (all.starts_with("\xff\xfe") || all.starts_with("\xfe\xff"))
            return fromUtf16(all.substr(2), all.front() == '\xff' ? 1 : 0);
        if (all.size() > 1 && (all[0] == '\0') != (all[1] == '\0'))
            return fromUtf16(all, all[0] == '\0' ? 0 : 1);
        return text;
    }

    void unifyLineEnds(std::string &text)
    {
        std::size_t to = 0;
        for (std::size_t from = 0; from < text.size(); ++from)
            if (text[from] != '\r')
                text[to++] = text[from];
            else if (from + 1 == text.size() || text[from + 1] != '\n')
                text[to++] = '\n';
        text.resize(to);
    }

    std::string_view trimmed(std::string_view text)
    {
        const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
        const std::size_t last = text.find_last_not_of(' ');
        return text.substr(first, last == std::string_view::npos ? 0 : last + 1 - first);
    }

    /// The one that a header has most of, outside quotes.
    char separatorOf(std::string_view header)
    {
        std::ptrdiff_t tabs = 0, semicolons = 0, commas = 0;
        bool isQuoted = false;
        for (const char c : header) {
            isQuoted = isQuoted != (c == '"');
            tabs += !isQuoted && c == '\t';
            semicolons += !isQuoted && c == ';';
            commas += !isQuoted && c == ',';
        }
        if (tabs > 0)
            return '\t';
        return semicolons > commas ? ';' : ',';
    }

} // namespace

std::string readTableText(const std::string &path)
{
    constexpr std::uintmax_t mostBytes = 64u << 20;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw Error(path, std::string("cannot be read: ") + std::strerror(errno));
    if (std::error_code code; std::filesystem::is_directory(path, code))
        throw Error(path, "is a folder; expected a table of text");
    std::string text;
    std::vector<char> block(1 << 16);
    while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
        text.append(block.data(), std::size_t(file.gcount()));
        if (text.size() > mostBytes)
            throw Error(path, "is larger than 64 MiB; expected a table of text, not samples");
    }
    text = inUtf8(std::move(text));
    unifyLineEnds(text);
    return text;
}

TextTable::TextTable(std::string path, const std::string &text, bool hasHeader) : m_path(std::move(path)), m_text(text)
{
    std::string first;
    if (!hasHeader || !nextLine(first))
        return;
    char named = 0;
    if (first.size() == 5 && first.starts_with("sep=")) { // as spreadsheets write it
        named = first.back();
        nextLine(first);
    }
    m_separator = named ? named : separatorOf(first);
    m_hasQuotes = m_separator != '\t' || trimmed(first).starts_with('"');
    bool isOpen = false;
    for (const std::string &name : split(first, isOpen))
        m_header.emplace_back(trimmed(name));
}

std::ptrdiff_t TextTable::column(std::string_view name) const
{
    const auto found = std::find(m_header.begin(), m_header.end(), name);
    return found == m_header.end() ? -1 : found - m_header.begin();
}

std::ptrdiff_t TextTable::neededColumn(std::string_view name) const
{
    if (const std::ptrdiff_t found = column(name); found >= 0)
        return found;
    throw Error(place(), "missing column \"" + std::string(name) + "\"");
}

bool TextTable::nextLine(std::string &line)
{
    if (m_at >= m_text.size())
        return false;
    const std::size_t end = std::min(m_text.find('\n', m_at), m_text.size());
    line.assign(m_text, m_at, end - m_at);
    m_at = end + 1;
    ++m_line;
    return true;
}

/// A quote begins a quoted cell at its start only; elsewhere it is text, as in 5" pipe.
std::vector<std::string> TextTable::split(const std::string &line, bool &isOpen) const
{
    std::vector<std::string> cells(1);
    bool isQuoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (isQuoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            cells.back().push_back(line[++i]);
        else if (isQuoted && c == '"')
            isQuoted = false;
        else if (!isQuoted && c == m_separator)
            cells.emplace_back();
        else if (m_hasQuotes && !isQuoted && c == '"' && trimmed(cells.back()).empty())
            isQuoted = true;
        else
            cells.back().push_back(c);
    }
    isOpen = isQuoted;
    return cells;
}

/// A quoted cell may contain line ends.
bool TextTable::nextCells()
{
    std::string line;
    if (!nextLine(line))
        return false;
    bool isOpen = false;
    m_row = split(line, isOpen);
    constexpr int mostLines = 100;
    for (int lines = 1; isOpen; ++lines) {
        std::string more;
        if (lines == mostLines || !nextLine(more))
            throw Error(place(), "a quoted cell does not end");
        line += " " + more;
        if (more.find('"') != std::string::npos)
            m_row = split(line, isOpen);
    }
    return true;
}

bool TextTable::next()
{
    while (nextCells()) {
        if (!m_header.empty() && m_row.size() > m_header.size())
            throw Error(place(), "has more columns than the header");
        if (std::ranges::any_of(m_row, [](const std::string &one) { return !trimmed(one).empty(); }))
            return true;
    }
    return false;
}

std::string TextTable::place() const
{
    return m_path + ", line " + std::to_string(m_line);
}

std::string TextTable::cell(std::ptrdiff_t column) const
{
    return column < 0 || column >= std::ssize(m_row) ? std::string() : m_row[std::size_t(column)];
}

double TextTable::number(std::ptrdiff_t column, const std::string &what)
{
    std::string text(trimmed(cell(column)));
    const std::size_t mark = text.find_first_of(".,");
    if (mark != std::string::npos) {
        if (m_decimalMark && text[mark] != m_decimalMark)
            throw Error(place(), "\"" + oneLine(text.substr(0, 40)) + "\" for " + what
                                     + " has another decimal mark than the numbers before it");
        m_decimalMark = text[mark];
        text[mark] = '.';
    }
    double value = 0.0;
    const char *begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw Error(place(), "\"" + oneLine(cell(column).substr(0, 40)) + "\" is not a number for " + what);
    return value;
}

std::optional<double> TextTable::numberIfAny(std::ptrdiff_t column, const std::string &what)
{
    return trimmed(cell(column)).empty() ? std::nullopt : std::optional(number(column, what));
}

} // namespace faintline
