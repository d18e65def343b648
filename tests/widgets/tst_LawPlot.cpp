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
        QCOMPARE(m_plot->selected(), 0);
        QTest::keyClick(m_plot.get(), Qt::Key_Left);
        QCOMPARE(m_plot->selected(), 0); // the middle is the first
        for (int change = 1; change <= 3; ++change) {
            QTest::keyClick(m_plot.get(), Qt::Key_Right);
            QCOMPARE(m_plot->selected(), change);
        }
        QTest::keyClick(m_plot.get(), Qt::Key_Right);
        QCOMPARE(m_plot->selected(), m_plot->reach()); // and the one that stands ready the last
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
        QCOMPARE(m_plot->selected(), 1);
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
        QCOMPARE(m_plot->reach(), 2); // and none stands ready
    }

    void aBarMoreThanTheLawHas()
    {
        QCOMPARE(m_plot->reach(), 3);
        m_plot->setLaw({0.5, 0.2, 0.05}, 2);
        QCOMPARE(m_plot->reach(), 2); // no rate can change by more
        m_plot->setLaw({1.0}, 6);
        QCOMPARE(m_plot->reach(), 1);
        QSignalSpy requested(m_plot.get(), &LawPlot::lawRequested);
        QTest::keyClick(m_plot.get(), Qt::Key_Right);
        QTest::keyClick(m_plot.get(), Qt::Key_Up, Qt::ShiftModifier);
        const auto law = requested.front().front().value<std::vector<double>>();
        QCOMPARE(law.size(), std::size_t(2));
        QVERIFY(std::abs(law[0] - 0.8) < 1e-12 && std::abs(law[1] - 0.1) < 1e-12);
    }

private:
    static double sum(const std::vector<double> &law)
    {
        return law.front() + 2.0 * std::accumulate(law.begin() + 1, law.end(), 0.0);
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
