#pragma once

#include <QtTest>

#include <functional>
#include <map>
#include <string>

namespace faintline::test {

/// The test classes of this program, by name.
inline std::map<std::string, std::function<int(int, char **)>> &classes()
{
    static std::map<std::string, std::function<int(int, char **)>> all;
    return all;
}

/// Whether the long lane runs, which measures error rates in full; the quick one tries a seed or a few of each.
inline bool isLong()
{
    return qEnvironmentVariableIntValue("FAINTLINE_LONG") > 0;
}

struct Registration {
    Registration(const char *name, std::function<int(int, char **)> run) { classes().emplace(name, std::move(run)); }
};

} // namespace faintline::test

/// Adds a test class to its program, which runs it as `PROGRAM CLASS [FUNCTION …]`, after the given set-up.
#define FAINTLINE_REGISTER_TEST(Class, ...)                                                                            \
    static const faintline::test::Registration registered_##Class(#Class, [](int argc, char **argv) {                  \
        __VA_ARGS__                                                                                                    \
        Class test;                                                                                                    \
        QTEST_SET_MAIN_SOURCE_PATH                                                                                     \
        return QTest::qExec(&test, argc, argv);                                                                        \
    });

#define FAINTLINE_TEST(Class) FAINTLINE_REGISTER_TEST(Class, QCoreApplication application(argc, argv);)
/// With a QApplication, or without widgets a QGuiApplication.
#define FAINTLINE_WINDOW_TEST(Class) FAINTLINE_REGISTER_TEST(Class, QTEST_MAIN_SETUP())
