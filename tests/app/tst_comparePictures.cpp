#include "app/headless/comparePictures.h"
#include "app/headless/pictureResults.h"
#include "base/json.h"
#include "support/files.h"
#include "support/test.h"

#include "support/errors.h"
#include "widgets/base/ReadOut.h"
#include "widgets/base/Theme.h"
#include "widgets/plot/ColourMap.h"

#include <QPixmap>

using namespace faintline;
using namespace faintline::test;

namespace {

QImage plain(QSize size, QRgb colour = qRgb(10, 20, 30))
{
    QImage image(size, QImage::Format_RGB32);
    image.fill(colour);
    return image;
}

/// The line of figures under the pictures, at one level.
QImage readOutAt(double levelDb)
{
    ReadOut readOut;
    readOut.resize(1200, 30);
    readOut.setReading({12.5, 1000.0, levelDb, 20.0, 0.1});
    return readOut.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

} // namespace

class tst_comparePictures : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    std::string path(const char *name) const { return m_folder.filePath(QLatin1String(name)).toStdString(); }
    void save(const QImage &image, const char *name) const
    {
        const QString where = m_folder.filePath(QLatin1String(name));
        QVERIFY(QDir().mkpath(QFileInfo(where).path()));
        QVERIFY(image.save(where, "PNG"));
    }
    /// What the command says, "" where all is the same.
    static std::string refusal(const CheckOptions &options)
    {
        return test::errorOf([&] { runCheckPictures(options); });
    }

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void samePicturesAreTheSame()
    {
        const PictureDifference difference = comparePictures(readOutAt(7.1), readOutAt(7.1));
        QVERIFY(difference.isEqual());
        QVERIFY(difference.picture.isNull());
    }

    void oneChangedDigitIsFound()
    {
        const PictureDifference difference = comparePictures(readOutAt(7.1), readOutAt(7.8));
        QVERIFY(!difference.isEqual());
        QCOMPARE(difference.places.size(), std::size_t(1));
        const QRect digit = difference.places.front();
        QVERIFY2(digit.width() <= 12 && digit.height() <= 16, "the box is round one digit");
        // Nor does the tolerance for rasters let it through.
        QVERIFY(!comparePictures(readOutAt(7.1), readOutAt(7.8), true).isEqual());
        // What changed is red, what did not is pale.
        QCOMPARE(difference.picture.size(), readOutAt(7.1).size());
        QVERIFY(qGray(difference.picture.pixel(0, 0)) >= 200);
        int red = 0;
        for (int y = digit.top(); y <= digit.bottom(); ++y)
            for (int x = digit.left(); x <= digit.right(); ++x)
                red += difference.picture.pixel(x, y) == qRgb(214, 0, 28);
        QCOMPARE(red, int(difference.changedPixels));
    }

    void changesFarApartAreTwoPlaces()
    {
        QImage changed = plain({200, 100});
        changed.setPixel(3, 4, qRgb(0, 0, 0));
        changed.setPixel(190, 90, qRgb(0, 0, 0));
        const PictureDifference difference = comparePictures(plain({200, 100}), changed);
        QCOMPARE(difference.changedPixels, 2);
        QCOMPARE(difference.places, (std::vector<QRect>{{3, 4, 1, 1}, {190, 90, 1, 1}}));
    }

    void aRasterMayBeOneColourOffInOneOf100000()
    {
        const auto &entries = ColourMap::named("viridis").entries();
        const QImage expected = plain({1000, 200}, entries[100]);
        QImage off = expected;
        off.setPixel(5, 5, entries[101]);
        off.setPixel(6, 5, entries[99]);
        QVERIFY(!comparePictures(expected, off).isEqual()); // only who asks for it
        const PictureDifference two = comparePictures(expected, off, true);
        QVERIFY(two.isEqual());
        QCOMPARE(two.toleratedPixels, 2);
        off.setPixel(7, 5, entries[99]); // three of 200 000
        QCOMPARE(comparePictures(expected, off, true).changedPixels, 3);
        QImage far = expected;
        far.setPixel(5, 5, entries[102]);
        QCOMPARE(comparePictures(expected, far, true).changedPixels, 1);
    }

    void anotherSizeIsADifference() { QVERIFY(!comparePictures(plain({10, 10}), plain({10, 11})).isEqual()); }

    void foldersAreReportedOnOnePage()
    {
        save(plain({20, 10}), "e/same.png");
        save(plain({20, 10}), "a/same.png");
        save(plain({20, 10}), "e/sub/a & b.png");
        save(plain({20, 10}, qRgb(0, 0, 0)), "a/sub/a & b.png");
        save(plain({20, 10}), "e/gone.png");
        save(plain({20, 10}), "a/fresh.png");
        const CheckOptions options{path("e"), path("a"), path("out"), false};
        const std::vector<CheckedPicture> pictures = checkPictures(options);
        using State = CheckedPicture::State;
        std::vector<State> states;
        for (const CheckedPicture &one : pictures)
            states.push_back(one.state);
        QCOMPARE(states, (std::vector<State>{State::New, State::Missing, State::Same, State::Different}));

        const QDir out(m_folder.filePath("out"));
        QCOMPARE(readBytes(out.filePath("expected/sub/a & b.png")), readBytes(m_folder.filePath("e/sub/a & b.png")));
        QCOMPARE(readBytes(out.filePath("actual/fresh.png")), readBytes(m_folder.filePath("a/fresh.png")));
        QVERIFY(out.exists("difference/sub/a & b.png"));
        QVERIFY(!out.exists("expected/same.png"));
        const QByteArray page = readBytes(out.filePath("index.html"));
        QVERIFY(page.contains("3 of 4 picture(s) differ"));
        QVERIFY(page.contains("src=\"difference/sub/a%20%26%20b.png\""));
        QVERIFY(page.contains("a &amp; b.png"));
        QVERIFY(!page.contains(m_folder.path().toUtf8())); // moves as a whole
        QVERIFY(refusal(options).find("3 of 4") != std::string::npos);
        QVERIFY(refusal({path("e"), path("e"), {}, false}).empty());
    }

    void resultsAreReadableByPrograms()
    {
        save(plain({20, 10}), "two/same.png");
        save(plain({20, 10}), "now/same.png");
        save(plain({20, 10}), "two/a & <b>.png");
        QImage changed = plain({20, 10});
        changed.setPixel(3, 4, qRgb(0, 0, 0));
        save(changed, "now/a & <b>.png");
        save(plain({20, 10}), "two/gone.png");

        QVERIFY(refusal({path("two"), path("now"), {}, false, path("results.xml")}).find("2 of 3")
                != std::string::npos);
        QXmlStreamReader xml(readBytes(m_folder.filePath("results.xml")));
        QStringList cases;
        QStringList failures;
        while (!xml.atEnd())
            if (xml.readNext() == QXmlStreamReader::StartElement) {
                const QXmlStreamAttributes values = xml.attributes();
                if (xml.name() == QLatin1String("testsuite"))
                    QCOMPARE((QStringList{values.value("tests").toString(), values.value("failures").toString()}),
                             (QStringList{"3", "2"}));
                if (xml.name() == QLatin1String("testcase"))
                    cases << values.value("name").toString();
                if (xml.name() == QLatin1String("failure"))
                    failures << cases.back() + ": " + values.value("message").toString();
            }
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        QCOMPARE(cases, (QStringList{"a & <b>.png", "gone.png", "same.png"}));
        QCOMPARE(failures, (QStringList{"a & <b>.png: 1 pixel(s) changed in 1 place(s)",
                                        "gone.png: missing: expected but not found"}));

        const Json json = parseJson(resultsJson(checkPictures({path("two"), path("now"), {}, false})), "results");
        QCOMPARE(json.at("compared"), 3);
        QCOMPARE(json.at("differing"), 2);
        QCOMPARE(json.at("pictures")[0].at("state"), "different");
        QCOMPARE(json.at("pictures")[0].at("places"), Json::array({{{"x", 3}, {"y", 4}, {"width", 1}, {"height", 1}}}));
        QCOMPARE(json.at("pictures")[1].at("actual"), Json(nullptr));
        QCOMPARE(json.at("pictures")[2].at("state"), "same");
        QVERIFY(!refusal({path("two"), path("two"), {}, false, path("two/same.png")}).empty()); // would be replaced
    }

    /// As examples/screenshots/README.md says it.
    void foldersMayBeRelative()
    {
        save(plain({20, 10}), "relative/expected/same.png");
        save(plain({20, 10}), "relative/out/now/same.png");
        save(plain({20, 10}), "relative/expected/sub/other.png");
        save(plain({20, 10}, qRgb(0, 0, 0)), "relative/out/now/sub/other.png");
        const QString before = QDir::currentPath();
        QVERIFY(QDir::setCurrent(m_folder.filePath("relative")));
        const std::vector<CheckedPicture> pictures = checkPictures({"expected", "out/now", "out/report", false});
        QDir::setCurrent(before);
        QCOMPARE(pictures.size(), std::size_t(2));
        QCOMPARE(pictures[0].name, QStringLiteral("same.png"));
        QCOMPARE(pictures[0].state, CheckedPicture::State::Same);
        QCOMPARE(pictures[1].state, CheckedPicture::State::Different);
        QVERIFY(QFile::exists(m_folder.filePath("relative/out/report/difference/sub/other.png")));
    }

    void refusalsAreOneLine()
    {
        save(plain({4, 4}), "p.png");
        QVERIFY(QDir().mkpath(m_folder.filePath("empty")));
        QFile broken(m_folder.filePath("broken.png"));
        QVERIFY(broken.open(QIODevice::WriteOnly));
        broken.write("no picture");
        broken.close();
        for (const CheckOptions &options : {CheckOptions{path("nowhere.png"), path("p.png"), {}, false},
                                            CheckOptions{path("p.png"), path("empty"), {}, false},
                                            CheckOptions{path("empty"), path("empty"), {}, false},
                                            CheckOptions{path("p.png"), path("broken.png"), {}, false},
                                            CheckOptions{path("e"), path("a"), path("a/out"), false}}) {
            const std::string why = refusal(options);
            QVERIFY(!why.empty());
            QVERIFY(why.find('\n') == std::string::npos);
        }
    }
};

FAINTLINE_WINDOW_TEST(tst_comparePictures)

#include "tst_comparePictures.moc"
