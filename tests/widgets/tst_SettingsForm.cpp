#include "support/test.h"
#include "widgets/forms/SettingsForm.h"

#include "widgets/base/Theme.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/SettingRow.h"
#include "widgets/forms/fractionText.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>

using namespace faintline;

/// The form made from the fields: it has every setting, requests edits and shows errors.
class tst_SettingsForm : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_edits.clear();
        m_form = std::make_unique<SettingsForm>();
        connect(m_form.get(), &SettingsForm::settingEdited, this,
                [this](const QString &name, const FieldValue &value) { m_edits.emplace_back(name, value); });
        m_form->resize(320, 900);
        m_form->show();
        QVERIFY(QTest::qWaitForWindowActive(m_form.get()));
    }

    void everySettingHasAnEditor()
    {
        for (const auto &field : AnalysisSettings::fields()) {
            const QWidget *widget = m_form->editor(QString::fromStdString(field.name));
            QVERIFY2(widget, field.name.c_str());
            QVERIFY2(!widget->accessibleName().isEmpty(), field.name.c_str());
            QVERIFY2(widget->toolTip().contains(QString::fromStdString(field.sentence).toHtmlEscaped()),
                     field.name.c_str());
        }
    }

    void editsAreEmittedOnce()
    {
        type(editor<QLineEdit>("decide.falseAlarmsPerHour"), "0.5");
        type(editor<QLineEdit>("model.snr"), "1e-1");
        editor<QAbstractSpinBox>("model.highestSlope")->stepUp();
        auto *window = editor<QComboBox>("spectrogram.window");
        window->setFocus();
        QTest::keyClick(window, Qt::Key_Home);
        m_form->reveal("model.slopeChange");
        type(editor<QLineEdit>("model.slopeChange"), "0.5, 0.25");

        QCOMPARE(m_edits.size(), std::size_t(5));
        QCOMPARE(m_edits[0], (std::pair<QString, FieldValue>("decide.falseAlarmsPerHour", 0.5)));
        QCOMPARE(m_edits[1], (std::pair<QString, FieldValue>("model.snr", 0.1)));
        QCOMPARE(m_edits[2], (std::pair<QString, FieldValue>("model.highestSlope", 1.125)));
        QCOMPARE(m_edits[3], (std::pair<QString, FieldValue>("spectrogram.window", std::string("rectangular"))));
        QCOMPARE(m_edits[4], (std::pair<QString, FieldValue>("model.slopeChange", std::vector<double>{0.5, 0.25})));
    }

    void showingValuesEmitsNothing()
    {
        AnalysisSettings settings;
        settings.model.snr = 0.125;
        settings.model.highestSlope = 0.625;
        settings.model.slopesPerBin = 16;
        settings.spectrogram.window = WindowShape::BlackmanHarris;
        m_form->setSettings(settings);
        QCOMPARE(m_edits.size(), std::size_t(0));
        QCOMPARE(editor<QLineEdit>("model.snr")->text(), QString("0.125"));
        QCOMPARE(editor<QAbstractSpinBox>("model.highestSlope")->text(), QString("0.625"));
        QCOMPARE(editor<QSpinBox>("model.slopesPerBin")->value(), 16);
        QCOMPARE(editor<QComboBox>("spectrogram.window")->currentText(), QString("Blackman–Harris"));
    }

    void errorsFromOutside()
    {
        m_form->setError("model.slopeChange", "must sum to 1");
        QCOMPARE(errors(), QStringList{"must sum to 1"});
        QVERIFY(m_form->editor("model.slopeChange")->isVisible()); // its section unfolds to show it
        m_form->setError("no.such.field", "something else");
        QCOMPARE(errors().size(), 2);
        m_form->setSettings({});
        QVERIFY(errors().isEmpty());
    }

    void foldedFieldsAreScrolledTo()
    {
        const QString name = "track.bothWays"; // the last but those of single kinds of frames
        QVERIFY(m_form->editor(name)->visibleRegion().isEmpty());
        m_form->reveal(name);
        QCoreApplication::processEvents(); // lays out what was unfolded
        const QWidget *field = m_form->editor(name);
        QCOMPARE(field->visibleRegion().boundingRect(), field->rect());
    }

    void theWheelChangesNothingInPassing()
    {
        auto *slope = editor<QAbstractSpinBox>("model.highestSlope");
        m_form->editor("model.snr")->setFocus();
        const QPointF centre = slope->rect().center();
        QWheelEvent wheel(centre, slope->mapToGlobal(centre), {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(slope, &wheel);
        QCOMPARE(slope->text().toDouble(), AnalysisSettings().model.highestSlope);
        QCOMPARE(m_edits.size(), std::size_t(0));
    }

    /// A slope goes from one of the set to the next, whatever the set; a slope that is typed is taken as it is.
    void slopesStepAlongTheirSet()
    {
        AnalysisSettings settings;
        settings.model.slopesPerBin = 3;
        m_form->setSettings(settings);
        auto *slope = editor<QAbstractSpinBox>("model.lowestSlope");
        slope->setFocus();
        QTest::keyClick(slope, Qt::Key_Up);
        QTest::keyClick(slope, Qt::Key_Up);
        QTest::keyClick(slope, Qt::Key_Down);
        QCOMPARE(m_edits.size(), std::size_t(3));
        for (std::size_t i = 0; i < 3; ++i)
            QCOMPARE(m_edits[i], (std::pair<QString, FieldValue>("model.lowestSlope", (i == 1 ? -1.0 : -2.0) / 3.0)));
        slope->selectAll();
        QTest::keyClicks(slope, "-0.5");
        QTest::keyClick(slope, Qt::Key_Return);
        QCOMPARE(m_edits.back(), (std::pair<QString, FieldValue>("model.lowestSlope", -0.5)));
        slope->stepDown(); // from between two of them to the next
        QCOMPARE(m_edits.back(), (std::pair<QString, FieldValue>("model.lowestSlope", -2.0 / 3.0)));
        slope->selectAll();
        QTest::keyClicks(slope, "-101");
        QTest::keyClick(slope, Qt::Key_Return);
        QCOMPARE(m_edits.size(), std::size_t(5));
        QCOMPARE(errors().size(), 1);
    }

    /// What is open says what a bin a frame is; the other unit stands under the field, and arrows follow the same set.
    void slopesInEitherUnit()
    {
        m_form->setHzPerSecondOfABinAFrame(16.0);
        const auto shows = [this](const QString &text) {
            const auto labels = m_form->findChildren<QLabel *>();
            return std::any_of(labels.begin(), labels.end(),
                               [&](const QLabel *label) { return label->text() == text; });
        };
        QVERIFY(shows("16 Hz/s here"));
        AnalysisSettings settings;
        settings.model.slopeUnit = SlopeUnit::HzPerSecond;
        settings.model.lowestSlope = -5.0;
        settings.model.highestSlope = 250.0;
        m_form->setSettings(settings);
        QVERIFY(shows("Hz/s"));
        QVERIFY(shows("−0.375 bins/frame here"));
        auto *slope = editor<QAbstractSpinBox>("model.highestSlope");
        slope->setFocus();
        QTest::keyClick(slope, Qt::Key_Up);
        QCOMPARE(m_edits.back(), (std::pair<QString, FieldValue>("model.highestSlope", 252.0)));
        slope->selectAll();
        QTest::keyClicks(slope, "1601");
        QTest::keyClick(slope, Qt::Key_Return);
        QCOMPARE(errors().size(), 1);
        m_form->setSettings({});
        m_form->setHzPerSecondOfABinAFrame(0.0);
        QVERIFY(!shows("16 Hz/s here"));
        QVERIFY(shows("bins/frame"));
    }

    void labelsAreWords()
    {
        QCOMPARE(settingLabel("spectrogram.windowSeconds"), QString("Window length"));
        QCOMPARE(settingLabel("some.newThingHere"), QString("New thing here"));
        QCOMPARE(qobject_cast<QLineEdit *>(m_form->editor("selection.channels"))->placeholderText(),
                 QString("all, or 0, 1"));
        QCOMPARE(qobject_cast<QLineEdit *>(m_form->editor("family.members"))->placeholderText(),
                 QString("1, 2, 3 or -50, 50"));
        QCOMPARE(stageLabel("smd"), QString("Sequential Markov"));
        QCOMPARE(stageLabel("someStage"), QString("Some stage"));
    }

    void thirdsAreFractions()
    {
        const FieldValue law = std::vector{1.0 / 3.0, 1.0 / 3.0};
        QCOMPARE(fractionText(law), QString("1/3, 1/3"));
        QCOMPARE(std::get<std::vector<double>>(parseFieldValue(settingField("model.slopeChange"), "1/3, 1/3")),
                 std::get<std::vector<double>>(law));
        QCOMPARE(fractionText(0.05), QString("0.05"));
        QCOMPARE(fractionText(-2.0 / 7.0), QString("-2/7"));
        QCOMPARE(fractionText(0.123456789), QString("0.123456789"));
        AnalysisSettings settings;
        settings.model.slopeChange = {1.0 / 3.0, 1.0 / 3.0};
        m_form->setSettings(settings);
        QCOMPARE(qobject_cast<QLineEdit *>(m_form->editor("model.slopeChange"))->text(), QString("1/3, 1/3"));
    }

    /// Rows that the other settings make meaningless are not there, nor is "More" if it has no other row.
    void onlyWhatAppliesIsShown()
    {
        AnalysisSettings settings;
        const auto isShown = [&](const QString &name) {
            m_form->setSettings(settings);
            return !m_form->editor(name)->parentWidget()->isHidden();
        };
        const auto more = [&] {
            for (QToolButton *button : m_form->findChildren<QToolButton *>())
                if (button->accessibleName() == "More of " + stageLabel("smd"))
                    return button;
            return static_cast<QToolButton *>(nullptr);
        };
        QVERIFY(!isShown("smd.lnK") && more()->isHidden());
        std::get<SmdSettings>(settings.detector).reset = SmdSettings::Reset::Fixed;
        QVERIFY(isShown("smd.lnK") && !more()->isHidden());

        QVERIFY(!isShown("family.members") && !isShown("family.present") && isShown("family.relation"));
        settings.family.relation = FamilySettings::Relation::Harmonics;
        QVERIFY(isShown("family.members") && isShown("family.present"));

        QVERIFY(!isShown("subtract.leastDb"));
        settings.subtract.lines = true;
        QVERIFY(isShown("subtract.leastDb"));

        QVERIFY(isShown("model.slopeChange") && !isShown("model.rangeRateChange"));
        settings.model.motion = Motion::Manoeuvring;
        QVERIFY(!isShown("model.slopeChange") && isShown("model.rangeRateChange")
                && isShown("model.bearingRateChange"));

        QVERIFY(isShown("decide.inhibitCells") && isShown("decide.forgetCells"));
        settings.decide.inhibits = settings.decide.resets = false;
        QVERIFY(!isShown("decide.inhibitCells") && !isShown("decide.forgetCells"));

        QVERIFY(isShown("track.bothWays"));
        settings.detector = PofNSettings();
        QVERIFY(!isShown("track.bothWays") && !isShown("smd.reset") && isShown("pOfN.p"));
        QVERIFY(m_form->isOffered("track.bothWays") && !m_form->isOffered("smd.reset")); // for the command palette

        m_form->setError("family.members", "must differ"); // an error is seen where it is
        settings = {};
        m_form->setSettings(settings);
        m_form->reveal("smd.lnK"); // and so is a row that a lesson points to
        QVERIFY(m_form->editor("smd.lnK")->isVisible());
    }

private:
    template <class Editor>
    Editor *editor(const QString &name) const
    {
        return qobject_cast<Editor *>(m_form->editor(name));
    }
    void type(QLineEdit *edit, const QString &text)
    {
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    }
    /// Every visible sentence in an error's colour.
    QStringList errors() const
    {
        QStringList texts;
        for (const QLabel *label : m_form->findChildren<QLabel *>())
            if (!label->isHidden() && !label->text().isEmpty()
                && label->palette().color(QPalette::WindowText) == Theme::colours(Theme::Kind::Light).error)
                texts << label->text();
        return texts;
    }

    std::unique_ptr<SettingsForm> m_form;
    std::vector<std::pair<QString, FieldValue>> m_edits;
};

FAINTLINE_WINDOW_TEST(tst_SettingsForm)
#include "tst_SettingsForm.moc"
