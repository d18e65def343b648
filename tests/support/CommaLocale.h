#pragma once

#include <clocale>
#include <locale>
#include <string>

namespace faintline::test {

/// While it exists, both C++ and C write numbers as half the world does: 1.234,5.
class CommaLocale
{
public:
    CommaLocale() : m_before(std::locale::global(std::locale(std::locale(), new Comma)))
    {
        for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
            if (std::setlocale(LC_ALL, name))
                break;
    }
    ~CommaLocale()
    {
        std::locale::global(m_before);
        std::setlocale(LC_ALL, "C");
    }
    CommaLocale(const CommaLocale &) = delete;

private:
    class Comma : public std::numpunct<char>
    {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };

    std::locale m_before;
};

} // namespace faintline::test
