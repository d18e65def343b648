#include "app/features/settings/OwnPresets.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/openWindow.h"
#include "support/test.h"

#include <QApplication>
#include <QComboBox>
#include <QInputDialog>

using namespace faintline;
using namespace faintline::test;

/// Settings with a name of one's own: kept, offered, applied in another recording.
class tst_OwnPresets : public QObject
{
    Q_OBJECT

private slots:
    void keptInFilesThatTheCommandLineTakes()
    {
        const QString folder = m_folder.filePath("a");
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.5;
        settings.selection.fromSeconds = 12.0;
        OwnPresets(folder).save("Night watch", settings);
        const OwnPresets again(folder);
        QCOMPARE(again.all().size(), std::size_t(1));
        QCOMPARE(again.all().front().name, std::string("Night watch"));
        QCOMPARE(again.all().front().settings.spectrogram.windowSeconds, 0.5);
        QCOMPARE(again.all().front().settings.selection.fromSeconds, 0.0); // of no other recording
        QFile file(folder + "/Night watch.json");
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(settingsFromJson(file.readAll().toStdString(), "file").spectrogram.windowSeconds, 0.5);
    }

    void namesOfNoFileAreRefused()
    {
        OwnPresets presets(m_folder.filePath("b"));
        for (const char *name : {"", "../up", "a/b", ".hidden", "tab\t"})
            QVERIFY_EXCEPTION_THROWN(presets.save(name, {}), Error);
        QVERIFY_EXCEPTION_THROWN(OwnPresets(QString()).save("any", {}), Error);
    }

    void whatCannotBeReadIsLeftOut()
    {
        QVERIFY(QDir(m_folder.path()).mkpath("c"));
        writeFile(m_folder, "c/broken.json", "{");
        writeFile(m_folder, "c/good.json", "{}");
        QCOMPARE(OwnPresets(m_folder.filePath("c")).all().size(), std::size_t(1));
    }

    void inTheWindow()
    {
        const auto window =
            newWindow({1400, 900}, std::make_unique<QSettings>(m_folder.filePath("memory.ini"), QSettings::IniFormat));
        const QString scene = writeFile(m_folder, "noise.json",
                                        R"({"sampleRateHz": 200, "durationSeconds": 60, "noise": {"deviation": 1}})");
        QVERIFY(openAndSettle(*window, scene,
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
        auto *combo = window->panel<PipelinePanel>().findChildren<QComboBox *>().front();
        QCOMPARE(combo->currentText(), QString("Own settings"));
        QTimer::singleShot(0, this, [] {
            auto *dialog = qobject_cast<QInputDialog *>(QApplication::activeModalWidget());
            dialog->setTextValue("Half a second");
            dialog->accept();
        });
        window->panel<PipelinePanel>().savePreset();
        QCOMPARE(combo->currentText(), QString("Half a second"));
        QVERIFY(openAndSettle(*window, scene));
        QVERIFY(combo->currentText() != "Half a second");
        combo->setCurrentIndex(combo->findText("Half a second"));
        emit combo->activated(combo->currentIndex());
        QVERIFY(settle(*window));
        QCOMPARE(window->document().settings().spectrogram.windowSeconds, 0.5);
    }

private:
    QTemporaryDir m_folder;
};

FAINTLINE_WINDOW_TEST(tst_OwnPresets)
#include "tst_OwnPresets.moc"
