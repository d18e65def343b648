#include "app/document/ViewState.h"
#include "support/test.h"

#include "support/errors.h"

using namespace faintline;

class tst_ViewState : public QObject
{
    Q_OBJECT

private slots:
    void comesBackAsItWas()
    {
        ViewState view;
        view.visible = {{1.5, 2.5}, {-100.25, 100.0}};
        view.cursor = {2.0, 0.1};
        view.orientation = "leftToRight";
        view.isLogarithmic = view.isRadioAxis = view.isPolar = true;
        view.colourMap = "viridis";
        view.bearing = Span{10.0, 20.0};
        view.cursorBearing = 15.0;
        view.selectedEvent = 7;
        const ViewState back = viewFromJson(toJson(view), "s.faintline");
        QVERIFY(back.visible == view.visible && back.cursor == view.cursor);
        QVERIFY(back.bearing == view.bearing && back.cursorBearing == view.cursorBearing);
        QVERIFY(back.isLogarithmic && back.isRadioAxis && back.isPolar);
        QCOMPARE(back.orientation, view.orientation);
        QCOMPARE(back.colourMap, view.colourMap);
        QCOMPARE(back.selectedEvent, 7);
    }

    void refusalsNameTheFile()
    {
        for (const char *text : {R"({"cursor": [1]})", R"({"moon": 1})", R"({"seconds": 3, "hz": [1, 2]})", "[]"}) {
            const std::string said = test::errorOf([&] { viewFromJson(parseJson(text, "view"), "s.faintline"); });
            QVERIFY2(said.starts_with("s.faintline: "), said.c_str());
        }
    }
};

FAINTLINE_TEST(tst_ViewState)
#include "tst_ViewState.moc"
