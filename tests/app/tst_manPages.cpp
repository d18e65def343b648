// The manual pages name every command and every option that the programs' own help shows.

#include "support/slowdown.h"
#include "support/test.h"

namespace {

QString helpOf(const QString &program, const QStringList &command = {})
{
    QProcess process;
    process.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/") + program, command + QStringList{"--help"});
    return process.waitForFinished(60000 * faintline::test::slowdown) && process.exitCode() == 0
               ? QString::fromUtf8(process.readAllStandardOutput())
               : QString();
}

/// The page without its escapes: "\-" is a minus.
QString pageOf(const QString &program)
{
    QFile file(QStringLiteral(FAINTLINE_SOURCE_DIR "/resources/man/%1.1").arg(program));
    return file.open(QIODevice::ReadOnly)
               ? QString::fromUtf8(file.readAll()).replace(QStringLiteral("\\-"), QStringLiteral("-"))
               : QString();
}

QStringList found(const QString &text, const QString &pattern)
{
    QStringList result;
    for (auto matches = QRegularExpression(pattern, QRegularExpression::MultilineOption).globalMatch(text);
         matches.hasNext();)
        result << matches.next().captured(1);
    return result;
}

QStringList commandsOf(const QString &help)
{
    return found(help.section(QStringLiteral("Subcommands:"), 1), QStringLiteral("^  ([a-z-]+)"));
}

QStringList optionsOf(const QString &help)
{
    return found(help.section(QStringLiteral("Options:"), 1), QStringLiteral("^ +(?:-\\w,)?(--[a-z-]+)"));
}

/// As a whole word: --set is not --set-a.
bool names(const QString &page, const QString &word)
{
    return QRegularExpression(QStringLiteral("(^|[^\\w-])%1($|[^\\w-])").arg(QRegularExpression::escape(word)),
                              QRegularExpression::MultilineOption)
        .match(page)
        .hasMatch();
}

} // namespace

class tst_manPages : public QObject
{
    Q_OBJECT

private slots:
    void allIsNamed_data()
    {
        QTest::addColumn<QString>("program");
        QTest::newRow("window") << "faintline";
        QTest::newRow("command line") << "faintline-cli";
    }

    void allIsNamed()
    {
        QFETCH(QString, program);
        const QString page = pageOf(program);
        const QStringList commands = commandsOf(helpOf(program));
        QVERIFY(commands.size() >= 4);
        QStringList missing;
        QStringList options = optionsOf(helpOf(program));
        for (const QString &command : commands) {
            if (!names(page, command))
                missing << command;
            const QStringList own = optionsOf(helpOf(program, {command}));
            QVERIFY2(!own.isEmpty(), qPrintable(command));
            options << own;
        }
        QVERIFY(options.size() > 15);
        for (const QString &option : options)
            if (!names(page, option))
                missing << option;
        missing.removeDuplicates();
        QVERIFY2(missing.isEmpty(), qPrintable(missing.join(QStringLiteral(", "))));
    }
};

FAINTLINE_TEST(tst_manPages)
#include "tst_manPages.moc"
