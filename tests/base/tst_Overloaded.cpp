#include "base/Overloaded.h"
#include "support/test.h"

#include <string>
#include <variant>

using namespace faintline;

/// One lambda for each type.
class tst_Overloaded : public QObject
{
    Q_OBJECT

private slots:
    void theFittingLambdaIsCalled()
    {
        using Either = std::variant<int, std::string, double>;
        const auto name = [](const Either &value) {
            return std::visit(Overloaded{[](int) { return "whole"; }, [](const std::string &) { return "text"; },
                                         [](double) { return "real"; }},
                              value);
        };
        QCOMPARE(name(1), "whole");
        QCOMPARE(name(std::string("x")), "text");
        QCOMPARE(name(1.0), "real");
    }
};

FAINTLINE_TEST(tst_Overloaded)
#include "tst_Overloaded.moc"
