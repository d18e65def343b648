#pragma once

#include "signal/formats/NumPy.h"
#include "support/recordings.h"
#include "support/slowdown.h"

#include <QProcess>
#include <QtTest>

#include <functional>

namespace faintline::test {

/// faintline-cli from outside: the real program in a folder of its own, its files, its exit codes and what it says
/// where.
class CommandLineTest : public QObject
{
protected:
    struct Outcome {
        int code = -1;
        QByteArray out;
        QByteArray err;
    };

    static constexpr int patience = 120'000 * slowdown; ///< ms, for a machine that is busy with other things
    inline static const QString program = QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline-cli");
    /// For the line of `simulateLine`.
    inline static const QStringList lineSettings{"--set", "spectrogram.windowSeconds=0.5", "--set",
                                                 "decide.falseAlarmsPerHour=2"};

    /// Runs the program to its end.
    Outcome run(const QStringList &arguments, const std::function<void()> &inChild = {}) const
    {
        QProcess process;
        process.setWorkingDirectory(folder());
        if (inChild)
            process.setChildProcessModifier(inChild);
        process.start(program, arguments);
        if (!process.waitForFinished(patience) || process.exitStatus() != QProcess::NormalExit) {
            qWarning("%s: did not end by itself", qPrintable(arguments.join(' ')));
            return {};
        }
        return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
    }

    /// scene.json and, made of it, line.wav and truth.json: fifteen seconds of a line at 210 Hz in thirty of noise.
    void simulateLine() const
    {
        QVERIFY2(QFile::exists(program), "faintline-cli is not built");
        writeBytes(pathOf("scene.json"), R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 30, "seed": 3,
            "lines": [{"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 8, "durationSeconds": 15,
            "frequencyHz": 210,
                       "driftHzPerSecond": 0.2}]})");
        const Outcome made = run({"simulate", "scene.json", "--out", "line.wav", "--truth", "truth.json"});
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(made.code, 0);
        QCOMPARE(made.out, QByteArray());
    }

    QString folder() const { return m_folder.path(); }
    QString path(const QString &name) const { return m_folder.filePath(name); }
    std::string pathOf(const char *name) const { return path(name).toStdString(); }
    QByteArray content(const QString &name) const { return readBytes(path(name).toStdString()); }

private:
    QTemporaryDir m_folder;
};

/// Rows of a CSV file without its header, as numbers; empty where one is none.
inline std::vector<std::vector<double>> numbersOf(const QByteArray &csv)
{
    std::vector<std::vector<double>> rows;
    const QList<QByteArray> lines = csv.trimmed().split('\n');
    for (qsizetype i = 1; i < lines.size(); ++i) {
        rows.emplace_back();
        for (const QByteArray &cell : lines[i].split(',')) {
            bool isNumber = false;
            rows.back().push_back(cell.toDouble(&isNumber));
            if (!isNumber)
                return {};
        }
    }
    return rows;
}

inline void writeArray(const std::string &path, const std::vector<Index> &shape, const std::vector<float> &values)
{
    NumPyWriter writer(path, shape);
    writer.write(values);
    writer.finish();
}

} // namespace faintline::test
