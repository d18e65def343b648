#pragma once

#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QStringList>
#include <QTemporaryDir>
#include <QThread>

namespace faintline::test {

/// A sound server of the test's own with one device, a null sink: what is played to it comes out of its monitor,
/// sample by sample in real time, without sound hardware. The test's process and what it starts use it.
class PulseServer
{
public:
    PulseServer() : m_socket(m_folder.filePath(QStringLiteral("native")))
    {
        qputenv("PULSE_SERVER", "unix:" + m_socket.toUtf8());
        qputenv("PULSE_COOKIE", m_folder.filePath(QStringLiteral("cookie")).toUtf8());
        start();
    }
    ~PulseServer() { stop(); }

    /// Why there is none; empty where there is.
    QString whyNot() const { return m_whyNot; }

    void start()
    {
        if (QStandardPaths::findExecutable(QStringLiteral("pulseaudio")).isEmpty()) {
            m_whyNot = QStringLiteral("pulseaudio is not installed");
            return;
        }
        QProcessEnvironment own = QProcessEnvironment::systemEnvironment();
        for (const char *folder : {"HOME", "XDG_RUNTIME_DIR", "XDG_CONFIG_HOME", "PULSE_RUNTIME_PATH"})
            own.insert(QString::fromLatin1(folder), m_folder.path());
        m_server.setProcessEnvironment(own);
        m_server.start(QStringLiteral("pulseaudio"),
                       {"-n", "--daemonize=no", "--exit-idle-time=-1", "--disable-shm=yes", "--use-pid-file=no", "-L",
                        "module-native-protocol-unix auth-anonymous=1 socket=" + m_socket});
        QElapsedTimer timer;
        timer.start();
        while (timer.elapsed() < 10'000 && m_server.state() != QProcess::NotRunning)
            if (plug())
                return;
        m_whyNot = "pulseaudio does not start: " + QString::fromLocal8Bit(m_server.readAllStandardError()).simplified();
    }

    void stop()
    {
        m_server.kill();
        m_server.waitForFinished();
        QFile::remove(m_socket);
    }

    /// The null sink comes and goes, as a device that is plugged in and out.
    bool plug()
    {
        return ask({"load-module", "module-null-sink", "sink_name=null", "format=float32le", "rate=48000", "channels=1",
                    "channel_map=mono", "sink_properties=device.description=Nothing"});
    }
    void unplug() { ask({"unload-module", "module-null-sink"}); }

private:
    static bool ask(const QStringList &words)
    {
        QProcess asking;
        asking.start(QStringLiteral("pactl"), words);
        return asking.waitForFinished() && asking.exitCode() == 0;
    }

    QTemporaryDir m_folder;
    QString m_socket;
    QProcess m_server;
    QString m_whyNot;
};

} // namespace faintline::test
