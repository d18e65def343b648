#include "app/document/sourceAt.h"
#include "app/features/opening/OpenOptionsDialog.h"
#include "support/test.h"

#include "base/Error.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/errors.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

using namespace faintline;

class tst_sourceAt : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString file(const QString &name, const QByteArray &bytes) const
    {
        const QString path = m_folder.filePath(name);
        QFile file(path);
        if (file.open(QIODevice::WriteOnly))
            file.write(bytes);
        return path;
    }

private slots:
    void aJsonFileIsAScenario()
    {
        const Source source = sourceAt(
            file("a.json",
                 R"({"kind": "lines", "sampleRateHz": 100, "durationSeconds": 10, "lines": [{"frequencyHz": 20}]})"));
        QVERIFY(source.scene);
        QCOMPARE(nameOf(source), "a.json");
        const OpenedSource opened = openSource(source);
        QCOMPARE(opened.recording->info().sampleCount, Index(1000));
        QCOMPARE(opened.truth.lines.size(), std::size_t(1));
    }

    void aMistakeInAScenarioNamesFileAndKey()
    {
        const QString path =
            file("b.json", R"({"kind": "lines", "sampleRateHz": 100, "durationSeconds": 10, "moon": 1})");
        const std::string said = test::errorOf([&] { sourceAt(path); });
        QVERIFY2(said.starts_with(path.toStdString()), said.c_str());
        QVERIFY2(test::contains(said, "moon"), said.c_str());
    }

    void linesBesideARecordingAreItsTruth()
    {
        const SimulatedRecording simulated(
            *sourceAt(file("g.json", R"({"sampleRateHz": 100, "durationSeconds": 10, "lines": [{"frequencyHz": 20}]})"))
                 .scene);
        const QString path = m_folder.filePath("g.wav");
        writeRecording(simulated, path.toStdString());
        QVERIFY(openSource(sourceAt(path)).truth.lines.empty());
        file("g.truth.json", QByteArray::fromStdString(toJson(simulated.truth()).dump()));
        QCOMPARE(openSource(sourceAt(path)).truth, simulated.truth());
        file("g.truth.json", R"({"lines": [{"moon": 1}]})");
        const std::string said = test::errorOf([&] { openSource(sourceAt(path)); });
        QVERIFY2(test::contains(said, "g.truth.json") && test::contains(said, "moon"), said.c_str());
    }

    void linesAreAddedToRecordingsOnlyAndNotWithoutEnd()
    {
        const Source::Injection line{{{3.0, 0.5, 0.0, 0.0, 20.0}, 0.1}, 0, 1};
        Source source = sourceAt(file("f.json", R"({"kind": "lines", "sampleRateHz": 100, "durationSeconds": 10})"));
        source.injections.assign(2, line);
        QCOMPARE(openSource(source).truth.lines.size(), std::size_t(2));
        source.injections.assign(1001, line);
        QVERIFY_THROWS_EXCEPTION(Error, openSource(source));
        source = sourceAt(file("g.json", R"({"kind": "pings", "pings": 3, "rangeCells": 10, "beams": 4})"));
        source.injections = {line};
        QVERIFY_THROWS_EXCEPTION(Error, openSource(source));
    }

    void onlyBareSamplesNeedToBeAskedAbout()
    {
        QVERIFY(needsRawOptions(file("c.cf32", "0123456789abcdef"), {}));
        QVERIFY(needsRawOptions(file("c.iq", "0123456789abcdef"), {}));
        QVERIFY(!needsRawOptions(file("c.wav", "0123456789abcdef"), {}));
        QVERIFY(!needsRawOptions(m_folder.filePath("missing.cf32"), {})); // there is nothing to ask
        QVERIFY(!needsRawOptions(file("d.cf32", "0123456789abcdef"), {false, "cf32_le", 100.0}));
    }

    void theDialogBeginsWithWhatTheNameSays()
    {
        const QString path = file("e.cu8", "0123456789abcdef");
        OpenOptionsDialog dialog(path);
        QCOMPARE(dialog.options().rawType, std::string("cu8"));
        OpenOptionsDialog receiver(file("gqrx_20260123_235959_100000000_2000000_fc.raw", "0123456789abcdef"));
        QCOMPARE(receiver.options().rawType, std::string("cf32_le"));
        QCOMPARE(receiver.options().rawRateHz, 2e6);
        auto *rate = dialog.findChild<QLineEdit *>();
        rate->clear();
        QTest::keyClicks(rate, "8\r");
        const OpenedSource opened = openSource(sourceAt(path, dialog.options()));
        QVERIFY(opened.recording->info().isComplex);
        QCOMPARE(opened.recording->info().durationSeconds(), 1.0);
        rate->clear();
        QTest::keyClicks(rate, "moon\r");
        QVERIFY(!dialog.findChild<QDialogButtonBox *>()->button(QDialogButtonBox::Open)->isEnabled());
    }

    /// While it is typed, and refused where the file would hold no sample.
    void theDialogSaysHowLongTheRecordingIs()
    {
        OpenOptionsDialog dialog(file("h.ci16", QByteArray(4000, 'x')));
        auto *rate = dialog.findChild<QLineEdit *>("rawRateHz");
        auto *header = dialog.findChild<QSpinBox *>("rawHeaderBytes");
        const QAbstractButton *open = dialog.findChild<QDialogButtonBox *>()->button(QDialogButtonBox::Open);
        const auto says = [&](const QString &text) {
            return std::ranges::any_of(dialog.findChildren<QLabel *>(),
                                       [&](const QLabel *one) { return one->text() == text; });
        };
        rate->setText({});
        QTest::keyClicks(rate, "100");
        QVERIFY(says("Length 10 s") && open->isEnabled());
        QCOMPARE(rate->text(), "100");
        header->selectAll();
        QTest::keyClicks(header, "2000");
        QVERIFY(says("Length 5 s"));
        QTest::keyClicks(header, "0"); // 20000
        QVERIFY(says("No sample: the file has 4000 bytes") && !open->isEnabled());
        header->setValue(0);
        rate->setText({});
        QTest::keyClicks(rate, "48,000");
        QVERIFY(says("Length unknown") && !open->isEnabled());
    }

    /// Which is offered for pairs of real channels, and stays ticked when they become something else.
    void complexSamplesAreNoPairs()
    {
        OpenOptionsDialog dialog(file("i.s16", QByteArray(4000, 'x')));
        auto *pairs = dialog.findChild<QCheckBox *>("iq");
        QVERIFY(!pairs->isEnabled()); // of one channel
        dialog.findChild<QSpinBox *>("rawChannels")->setValue(2);
        QVERIFY(pairs->isEnabled());
        pairs->click();
        QVERIFY(dialog.options().iq);
        auto *type = dialog.findChild<QComboBox *>("rawType");
        QCOMPARE(type->itemData(0).toString(), "ci16_le");
        QCOMPARE(type->count(), 28);
        type->setCurrentIndex(0);
        emit type->activated(0);
        QVERIFY(!pairs->isEnabled() && pairs->isChecked() && !dialog.options().iq);
    }
};

FAINTLINE_WINDOW_TEST(tst_sourceAt)
#include "tst_sourceAt.moc"
