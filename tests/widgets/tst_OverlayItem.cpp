#include "support/test.h"
#include "widgets/waterfall/OverlayItem.h"

#include "pixels.h"

#include <qwt_scale_map.h>

#include <QPainter>

using namespace faintline;

/// What is drawn over a waterfall: where it lies, what gives way where there is too much, and that words stay on it.
class tst_OverlayItem : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Dark); }

    void init()
    {
        m_item = std::make_unique<OverlayItem>();
        m_item->colours = Theme::colours(Theme::Kind::Dark);
    }

    void cleanup() { Theme::setPlotScale(1.0); }

    void boxesLieWhereTheirAxesSay()
    {
        const Viewport::Box box{{20.0, 30.0}, {100.0, 140.0}};
        QCOMPARE(OverlayItem::rectOf(box, xMap(), yMap(), true), QRectF(250, 190, 80, 20));
        m_item->isTimeVertical = false;
        QCOMPARE(OverlayItem::rectOf(box, xMap(), yMap(), false), QRectF(130, 110, 40, 40));
        m_item->boxes = {{box, {}, false}};
        QVERIFY(isNear(marked(drawn()), QRect(130, 110, 41, 41)));
    }

    void framesAreNeverTooSmallToBeHit()
    {
        QCOMPARE(OverlayItem::frameOf({100, 50, 40, 20}), QRectF(96, 46, 48, 28));
        const QRectF frame = OverlayItem::frameOf({100, 50, 0, 0.5});
        QCOMPARE(frame.size(), QSizeF(13, 13));
        QCOMPARE(frame.center(), QPointF(100, 50.25));
    }

    void theCursorLeavesItsCellFree()
    {
        m_item->cursor = Viewport::Point{50.0, 100.0};
        const QImage image = drawn();
        for (int d = -6; d <= 6; ++d) {
            QCOMPARE(image.pixel(250 + d, 150), ground);
            QCOMPARE(image.pixel(250, 150 + d), ground);
        }
        for (const QPoint at : {QPoint(60, 150), QPoint(440, 150), QPoint(250, 60), QPoint(250, 240)})
            QVERIFY(image.pixel(at) != ground); // but reaches to every edge
    }

    void tracksGoThroughTheirPoints()
    {
        m_item->tracks = {{1, {{10.0, 20.0}, {50.0, 100.0}, {90.0, 180.0}}}};
        const QImage image = drawn();
        for (const double share : {0.15, 0.35, 0.5, 0.75})
            QVERIFY(image.pixel(QPointF(50 + 400 * share, 250 - 200 * share).toPoint()) != ground);
        QCOMPARE(image.pixel(250, 100), ground);
        QVERIFY(isNear(marked(image), QRect(QPoint(90, 70), QPoint(410, 230))));
    }

    void aLongTrackIsDrawnWhereItIsSeen()
    {
        QPolygonF points;
        for (int i = -500000; i < 500000; ++i)
            points << QPointF(0.01 * i, 100.0);
        m_item->tracks = {{1, points}};
        QVERIFY(isNear(marked(drawn()), QRect(249, 50, 3, 200)));
        m_item->tracks[0].points.translate(0.0, 1e9); // nowhere near
        QVERIFY(marked(drawn()).isNull());
    }

    void rejectedEventsAreFaint()
    {
        m_item->marks = {{4, {{40.0, 60.0}, {90.0, 110.0}}, true}};
        const auto difference = [&] {
            const QImage image = drawn();
            double sum = 0.0;
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x)
                    sum += std::abs(qGray(image.pixel(x, y)) - qGray(ground));
            return sum;
        };
        const double full = difference();
        m_item->faintEvents = {4};
        const double faint = difference();
        QVERIFY(faint > 0.0 && faint < 0.5 * full);
        m_item->selectedEvent = 4; // whoever selects it wants to see it
        QVERIFY(difference() > full);
    }

    void ofManyEventsTheTracksAreLeft()
    {
        for (int id = 1; id <= 100; ++id)
            m_item->marks.push_back({id, {{50.0, 51.0}, {double(id), id + 1.0}}, true});
        QVERIFY(marked(drawn()).isNull()); // their brackets would hide what they mark
        m_item->hasTracks = false;         // but there is nothing else then
        QVERIFY(!marked(drawn()).isNull());
        m_item->hasTracks = true;
        m_item->marks.resize(12);
        QVERIFY(!marked(drawn()).isNull());
    }

    void theSelectedEventIsShownAmongAnyNumber()
    {
        for (int id = 1; id <= 100; ++id)
            m_item->marks.push_back({id, {{50.0, 51.0}, {double(id), id + 1.0}}, true});
        m_item->selectedEvent = 70;
        const QImage image = drawn();
        QVERIFY(test::coloursOf(image).contains(m_item->colours.selectedEvent.rgb())); // with its number on a plate
        QVERIFY(std::abs(marked(image).left() - (50 + 2 * 70 - 6)) < 5);
    }

    void ofManyEventsTheOneUnderThePointerIsMarked()
    {
        for (int id = 1; id <= 13; ++id)
            m_item->marks.push_back({id, {{50.0, 51.0}, {10.0 * id, 10.0 * id + 1.0}}, true});
        QVERIFY(marked(drawn()).isNull());
        m_item->hoveredEvent = 7;
        QVERIFY(std::abs(marked(drawn()).left() - (50 + 2 * 70 - 6)) < 5);
        m_item->hoveredEvent = 0;
        m_item->marks.pop_back(); // twelve are few
        QVERIFY(std::abs(marked(drawn()).left() - (50 + 2 * 10 - 6)) < 5);
    }

    /// Plates of numbers: darker than any other part of a mark.
    void numbersDoNotLieOverEachOther()
    {
        const auto plates = [this](const std::vector<double> &hz) {
            m_item->marks.clear();
            for (const double at : hz)
                m_item->marks.push_back({int(m_item->marks.size()) + 1, {{40.0, 60.0}, {at, at + 2.0}}, true});
            const QImage image = drawn();
            return test::pixelsWhere(image, canvas, [](QRgb colour) { return qBlue(colour) < 22; }).size();
        };
        const auto one = plates({100.0});
        QVERIFY(one > 80);
        QVERIFY(double(plates({100.0, 101.0})) > 1.8 * double(one));
        QVERIFY(double(plates({100.0, 101.0, 102.0})) > 2.6 * double(one));
        QVERIFY(plates(std::vector<double>(12, 100.0)) < 6 * one); // there is no room for more
    }

    /// The bracket of an event that is drawn later begins where the number of the first one would be.
    void aNumberDoesNotLieUnderABracket()
    {
        const auto plates = [&](double start) {
            m_item->marks = {{1, {{20.0, 50.0}, {100.0, 104.0}}, true}, {2, {{start, 90.0}, {100.0, 104.0}}, true}};
            return test::pixelsWhere(drawn(), canvas, [](QRgb colour) { return qBlue(colour) < 22; }).size();
        };
        const auto apart = plates(70.0);
        QVERIFY(apart > 160);
        QVERIFY(double(plates(51.5)) > 0.97 * double(apart));
    }

    void layersAreLeftOut()
    {
        m_item->marks = {{1, {{40.0, 60.0}, {90.0, 110.0}}, true}};
        m_item->tracks = {{1, {{10.0, 20.0}, {90.0, 180.0}}}};
        m_item->truth = m_item->tracks;
        m_item->areas = {{{{10.0, 90.0}, {10.0, 190.0}}, {}, false}};
        m_item->hasEvents = m_item->hasTracks = false;
        QVERIFY(!marked(drawn()).isNull());
        m_item->hasTruth = false;
        QVERIFY(marked(drawn()).isNull()); // areas go with the events
    }

    void harmonicsStandAtTheMultiples()
    {
        m_item->harmonicsHz = {60.0, 120.0, 180.0, 240.0}; // the last one is beyond the edge
        const QImage image = drawn();
        for (const int x : {170, 290, 410}) {
            QVERIFY2(markedIn(image, {x, 80, 1, 170}).size() > 160, qPrintable(QString::number(x)));
        }
        QVERIFY(marked(image).right() < 440);
        QCOMPARE(image.pixel(230, 200), ground);
    }

    void sidebandsStandOnEitherSide()
    {
        m_item->sidebands = Sidebands{100.0, 10.0};
        const QImage image = drawn();
        for (int order = -Sidebands::orders; order <= Sidebands::orders; ++order)
            QVERIFY2(image.pixel(250 + 20 * order, 150) != ground || image.pixel(250 + 20 * order, 152) != ground,
                     qPrintable(QString::number(order)));
        QCOMPARE(image.pixel(260, 150), ground);
        QCOMPARE(image.pixel(250 + 20 * (Sidebands::orders + 1), 150), ground);
    }

    void wordsStayOnTheCanvas()
    {
        for (const double scale : {1.0, 2.0}) {
            Theme::setPlotScale(scale);
            // Where the figures would stand beyond the lower right corner.
            m_item->selection = Viewport::Box{{0.0, 2.0}, {196.0, 199.0}};
            m_item->selectionText = {};
            const QRect alone = marked(drawn());
            m_item->selectionText = "Δt 2.00 s · Δf 3.0 Hz\npeak 20.0 dB";
            const QImage image = drawn();
            QVERIFY(marked(image).left() < alone.left() - 60); // moved to where there is room
            QVERIFY(marked(image).width() - alone.width() > 60);
            QVERIFY(canvas.contains(marked(image)));
            const QRect words = marked(image);
            QVERIFY2(words.height() > 2 * 10 * scale, "both lines");
        }
    }

    void overAllFrequenciesABoxIsABand()
    {
        m_item->boxes = {{{{20.0, 30.0}, {-1e12, 1e12}}, {}, false}};
        const QImage image = drawn();
        QVERIFY(isNear(marked(image), QRect(50, 190, 400, 21)));
        QCOMPARE(image.pixel(250, 200), ground);
        m_item->boxes = {{{{200.0, 300.0}, {-1e12, 1e12}}, "later", false}};
        QVERIFY(marked(drawn()).isNull());
    }

    void nothingIsNothing()
    {
        QVERIFY(marked(drawn()).isNull());
        m_item->tracks = {{1, {}}};
        m_item->selectedEvent = 1;
        QVERIFY(marked(drawn()).isNull());
    }

private:
    static constexpr QRgb ground = 0xff204060;
    static QwtScaleMap map(double low, double high, double from, double to)
    {
        QwtScaleMap made;
        made.setScaleInterval(low, high);
        made.setPaintInterval(from, to);
        return made;
    }
    /// 0 … 100 s upwards and 0 … 200 Hz to the right, two pixels a second and Hz, in a margin of 50 pixels.
    QImage drawn() const
    {
        QImage image(500, 300, QImage::Format_RGB32);
        image.fill(ground);
        QPainter painter(&image);
        painter.setClipRect(QRectF(canvas));
        m_item->draw(&painter, xMap(), yMap(), QRectF(canvas));
        return image;
    }
    QwtScaleMap xMap() const { return m_item->isTimeVertical ? map(0, 200, 50, 450) : map(0, 100, 50, 450); }
    QwtScaleMap yMap() const { return m_item->isTimeVertical ? map(0, 100, 250, 50) : map(0, 200, 250, 50); }
    static QPolygon markedIn(const QImage &image, const QRect &part)
    {
        return test::pixelsWhere(image, part, [](QRgb colour) { return colour != ground; });
    }
    /// Of the pixels that differ from the ground.
    static QRect marked(const QImage &image) { return markedIn(image, image.rect()).boundingRect(); }
    static bool isNear(const QRect &a, const QRect &b, int most = 3)
    {
        return std::abs(a.left() - b.left()) <= most && std::abs(a.top() - b.top()) <= most
               && std::abs(a.right() - b.right()) <= most && std::abs(a.bottom() - b.bottom()) <= most;
    }

    const QRect canvas{50, 50, 400, 200};
    std::unique_ptr<OverlayItem> m_item;
};

FAINTLINE_WINDOW_TEST(tst_OverlayItem)
#include "tst_OverlayItem.moc"
