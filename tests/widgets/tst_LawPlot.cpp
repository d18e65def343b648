#include "support/test.h"
#include "widgets/plot/LawPlot.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <numeric>

using namespace faintline;

/// The law of a rate's change, changed by keys and by the mouse. A law sums to 1, h(0) + 2 Σ h(i).
class tst_LawPlot : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_plot = std::make_unique<LawPlot>();
        m_plot->setLaw({0.5, 0.2, 0.05}, 6);
        test::show(*m_plot, {500, 300});
        m_plot->setFocus();
    }

    void keysChooseABar()
    {
        for (const int rights : {0, 1, 2, 3, 4}) { // after the law's two bars one more stands ready, the last
            init();
            QTest::keyClick(m_plot.get(), Qt::Key_Left); // the middle is the first
            for (int i = 0; i < rights; ++i)
                QTest::keyClick(m_plot.get(), Qt::Key_Right);
            const std::vector<double> law = raised();
            const double before[] = {0.5, 0.2, 0.05, 0.0};
            for (std::size_t change = 0; change < law.size(); ++change)
                QCOMPARE(law[change] > before[change], int(change) == std::min(rights, 3));
        }
    }

    void keysChangeIt_data()
    {
        QTest::addColumn<int>("modifier");
        QTest::addColumn<double>("after");
        QTest::newRow("plain") << int(Qt::NoModifier) << 0.51;
        QTest::newRow("Shift") << int(Qt::ShiftModifier) << 0.6;
        QTest::newRow("Ctrl") << int(Qt::ControlModifier) << 0.501;
    }

    void keysChangeIt()
    {
        QFETCH(int, modifier);
        QFETCH(double, after);
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::keyClick(m_plot.get(), Qt::Key_Up, Qt::KeyboardModifiers(modifier));
        QCOMPARE(requested.size(), 1);
        const auto law = requested.front().front().value<std::vector<double>>();
        QVERIFY(std::abs(law[0] - after) < 1e-12);
        QVERIFY(std::abs(sum(law) - 1.0) < 1e-12);
        QVERIFY(std::abs(law[1] / law[2] - 4.0) < 1e-9); // the others keep their proportions
    }

    void upAndDownIsWhereOneWas()
    {
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::keyClick(m_plot.get(), Qt::Key_Up);
        m_plot->setLaw(requested.back().front().value<std::vector<double>>(), 6); // as whoever was asked does
        QTest::keyClick(m_plot.get(), Qt::Key_Down);
        const auto law = requested.back().front().value<std::vector<double>>();
        const double before[] = {0.5, 0.2, 0.05};
        QCOMPARE(law.size(), std::size(before));
        for (std::size_t i = 0; i < law.size(); ++i)
            QVERIFY(std::abs(law[i] - before[i]) < 1e-12);
    }

    void aBarIsDragged()
    {
        QSignalSpy dragged(m_plot.get(), &LawPlot::lawDragged);
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::mousePress(m_plot->canvas(), Qt::LeftButton, {}, at(-1.0, 0.2)); // the mirror image of h(1)
        move(at(-1.0, 0.3));
        QVERIFY(dragged.size() >= 1);
        QVERIFY(std::abs(m_plot->law()[1] - 0.3) < 0.01); // a pixel is 0.005
        QVERIFY(std::abs(sum(m_plot->law()) - 1.0) < 1e-12);
        QCOMPARE(requested.size(), 0);
        QTest::mouseRelease(m_plot->canvas(), Qt::LeftButton, {}, at(-1.0, 0.3));
        QCOMPARE(requested.size(), 1);
        QCOMPARE(requested.front().front().value<std::vector<double>>(), m_plot->law());
    }

    void aBarDoesNotJumpToThePointer()
    {
        QTest::mousePress(m_plot->canvas(), Qt::LeftButton, {}, at(0.0, 0.1)); // far below its top at 0.5
        move(at(0.0, 0.1));
        QVERIFY(std::abs(m_plot->law()[0] - 0.5) < 1e-9);
        move(at(0.0, 0.2));
        QVERIFY(std::abs(m_plot->law()[0] - 0.6) < 0.01);
        QTest::mouseRelease(m_plot->canvas(), Qt::LeftButton, {}, at(0.0, 0.2));
    }

    void escapeLetsItBe()
    {
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::mousePress(m_plot->canvas(), Qt::LeftButton, {}, at(0.0, 0.5));
        move(at(0.0, 0.8));
        QVERIFY(m_plot->law()[0] > 0.7);
        QTest::keyClick(m_plot.get(), Qt::Key_Escape);
        QCOMPARE(m_plot->law(), (std::vector<double>{0.5, 0.2, 0.05}));
        QTest::mouseRelease(m_plot->canvas(), Qt::LeftButton, {}, at(0.0, 0.8));
        QCOMPARE(requested.size(), 0);
    }

    void aFixedLawStays()
    {
        m_plot->setEditable(false);
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::keyClick(m_plot.get(), Qt::Key_Up);
        QTest::mousePress(m_plot->canvas(), Qt::LeftButton, {}, at(0.0, 0.5));
        move(at(0.0, 0.8));
        QTest::mouseRelease(m_plot->canvas(), Qt::LeftButton, {}, at(0.0, 0.8));
        QCOMPARE(requested.size(), 0);
        QCOMPARE(m_plot->law(), (std::vector<double>{0.5, 0.2, 0.05}));
    }

    void aBarMoreThanTheLawHas_data()
    {
        QTest::addColumn<std::vector<double>>("law");
        QTest::addColumn<int>("mostChange");
        QTest::addColumn<std::size_t>("bars");
        QTest::newRow("one more") << std::vector{0.5, 0.2, 0.05} << 6 << std::size_t(4);
        QTest::newRow("no rate can change by more") << std::vector{0.5, 0.2, 0.05} << 2 << std::size_t(3);
        QTest::newRow("of one") << std::vector{1.0} << 6 << std::size_t(2);
    }

    void aBarMoreThanTheLawHas()
    {
        QFETCH(std::vector<double>, law);
        QFETCH(int, mostChange);
        m_plot->setLaw(law, mostChange);
        for (int i = 0; i < 6; ++i)
            QTest::keyClick(m_plot.get(), Qt::Key_Right);
        const std::vector<double> after = raised();
        QTEST(after.size(), "bars");
        QVERIFY(std::abs(sum(after) - 1.0) < 1e-12);
        QVERIFY(after.back() > (after.size() > law.size() ? 0.0 : law.back()));
    }

private:
    static double sum(const std::vector<double> &law)
    {
        return law.front() + 2.0 * std::accumulate(law.begin() + 1, law.end(), 0.0);
    }
    /// The law that is asked for when the chosen bar is raised by key.
    std::vector<double> raised()
    {
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::keyClick(m_plot.get(), Qt::Key_Up, Qt::ShiftModifier);
        return requested.value(0).value(0).value<std::vector<double>>();
    }
    QPoint at(double change, double probability) const
    {
        return {int(m_plot->transform(QwtAxis::XBottom, change)), int(m_plot->transform(QwtAxis::YLeft, probability))};
    }
    void move(const QPoint &to)
    {
        QWidget *canvas = m_plot->canvas();
        QMouseEvent event(QEvent::MouseMove, to, canvas->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
        QCoreApplication::sendEvent(canvas, &event);
    }

    std::unique_ptr<LawPlot> m_plot;
};

FAINTLINE_WINDOW_TEST(tst_LawPlot)
#include "tst_LawPlot.moc"
