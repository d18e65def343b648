#include "app/features/inspect/ChannelsPanel.h"
#include "support/test.h"

#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "base/Random.h"
#include "signal/ArrayRecording.h"
#include "signal/formats/writeRecording.h"
#include "widgets/waterfall/LinkedPictures.h"

#include <qwt_text.h>

#include <QMenuBar>

#include <cmath>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double rate = 500.0;
constexpr Index sampleCount = 15'000;

/// Noise in every channel; in the last one a line at 120 Hz.
QString recordingOf(const QTemporaryDir &folder, int channels)
{
    const auto samples = std::make_shared<std::vector<float>>(std::size_t(sampleCount * channels));
    Random(3, 1).normals(*samples, 0.1f);
    for (Index n = 0; n < sampleCount; ++n)
        (*samples)[std::size_t((n + 1) * channels - 1)] +=
            0.1f * float(std::sin(2.0 * std::numbers::pi * 120.0 * double(n) / rate));
    const ArrayRecording recording("made", std::shared_ptr<const float>(samples, samples->data()),
                                   {rate, sampleCount, channels, false, 0.0});
    const QString path = folder.filePath(QStringLiteral("channels%1.wav").arg(channels));
    writeRecording(recording, path.toStdString());
    return path;
}

void makeQuick(AnalysisSettings &settings)
{
    settings.spectrogram.windowSeconds = 0.5;
    setSetting(settings, "detector.kind", "energy");
}

QStringList titlesOf(const ChannelsPanel &panel)
{
    QStringList titles;
    for (int place = 0; place < panel.pictures().count(); ++place)
        titles << panel.pictures().at(place).title().text();
    return titles;
}

/// The panel is shown and has computed its pictures.
bool showAndSettle(MainWindow &window)
{
    window.showView("channels");
    QCoreApplication::processEvents();
    return settle(window.panel<ChannelsPanel>());
}

} // namespace

/// Channels of a recording beside each other.
class tst_ChannelsPanel : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void allChannelsAreShown()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 2), makeQuick));
        ChannelsPanel &panel = window->panel<ChannelsPanel>();
        QVERIFY(!isBusy(panel)); // nothing is computed for a hidden panel
        QVERIFY(showAndSettle(*window));
        QVERIFY2(sentenceOf(panel).isEmpty(), qPrintable(sentenceOf(panel)));
        QCOMPARE(titlesOf(panel), QStringList({"Channel 0, analysed", "Channel 1"}));
        const auto levelAt = [&](int place) {
            double sum = 0.0;
            for (int i = 0; i < 50; ++i)
                sum += panel.pictures().at(place).valueAt(5.0 + 0.4 * i, 120.0).value_or(-100.0);
            return sum / 50.0;
        };
        QVERIFY2(levelAt(1) > levelAt(0) + 10.0, qPrintable(QString::number(levelAt(1) - levelAt(0))));
        QVERIFY(panel.pictures().at(0).range() == panel.pictures().at(1).range());
    }

    void zoomAndCursorAreThoseOfTheWindow()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 2), makeQuick));
        QVERIFY(showAndSettle(*window));
        LinkedPictures &pictures = window->panel<ChannelsPanel>().pictures();
        Viewport &viewport = window->document().viewport();
        viewport.zoomTo({10.0, 20.0}, {100.0, 140.0});
        for (int place = 0; place < 2; ++place) {
            const WaterfallView &view = pictures.at(place);
            const Viewport::Point corner = view.pointAt({0.0, double(view.canvas()->height())});
            QVERIFY(std::abs(corner.seconds - 10.0) < 0.3 && std::abs(corner.hz - 100.0) < 0.5);
        }
        const QPointF at = pictures.at(0).positionOf({15.0, 130.0});
        QTest::mouseClick(pictures.at(0).canvas(), Qt::LeftButton, {}, at.toPoint());
        QVERIFY(std::abs(viewport.cursor()->hz - 130.0) < 1.0 && std::abs(viewport.cursor()->seconds - 15.0) < 0.3);
        QCOMPARE(window->document().undoStack().count(), 0); // the analysed channel is not chosen again
    }

    void aClickSelectsTheChannel()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 3), makeQuick));
        QVERIFY(showAndSettle(*window));
        ChannelsPanel &panel = window->panel<ChannelsPanel>();
        const auto kept = panel.pictures().at(1).picture();
        QTest::mouseClick(panel.pictures().at(2).canvas(), Qt::LeftButton, {}, {20, 20});
        QCOMPARE(window->document().settings().selection.channel, 2);
        QVERIFY(settle(*window));
        QCOMPARE(titlesOf(panel), QStringList({"Channel 0", "Channel 1", "Channel 2, analysed"}));
        QCOMPARE(window->document().analysis()->settings.selection.channel, 2);
        QVERIFY(panel.pictures().at(1).picture() == kept); // the pictures stay
        window->document().undoStack().undo();
        QCOMPARE(window->document().settings().selection.channel, 0);
        QVERIFY(settle(*window));
        QCOMPARE(titlesOf(panel).first(), QString("Channel 0, analysed"));
        QTest::keyClick(&panel.pictures().at(1), Qt::Key_Return);
        QCOMPARE(window->document().settings().selection.channel, 1);
        QVERIFY(settle(*window));
    }

    void addedChannelsAreMarked()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 3), [](AnalysisSettings &settings) {
            makeQuick(settings);
            settings.selection.channels = {0.0, 2.0};
        }));
        QVERIFY(showAndSettle(*window));
        QCOMPARE(titlesOf(window->panel<ChannelsPanel>()),
                 QStringList({"Channel 0, analysed", "Channel 1", "Channel 2, analysed"}));
        QTest::mouseClick(window->panel<ChannelsPanel>().pictures().at(0).canvas(), Qt::LeftButton, {}, {20, 20});
        QVERIFY(window->document().settings().selection.channels.empty()); // this one alone
        QVERIFY(settle(*window));
    }

    void otherFramesAreComputedAgain()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 2), makeQuick));
        QVERIFY(showAndSettle(*window));
        ChannelsPanel &panel = window->panel<ChannelsPanel>();
        const auto before = panel.pictures().at(0).picture();
        window->controller().edit("spectrogram.windowSeconds", 1.0, "longer");
        QVERIFY(settle(*window));
        QVERIFY(settle(panel));
        QVERIFY(panel.pictures().at(0).picture() && panel.pictures().at(0).picture() != before);
        QCOMPARE(panel.pictures().at(1).picture()->time().count, window->document().analysis()->time().count);
        window->controller().edit("spectrogram.windowSeconds", 0.5, "shorter");
        window->open(recordingOf(m_folder, 3), {}, makeQuick); // supersedes what is being computed
        QVERIFY(settle(*window) && settle(panel));
        QCOMPARE(panel.pictures().count(), 3);
    }

    void atMostEightAtOnce()
    {
        const auto window = newWindow({1280, 800});
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 11), makeQuick));
        QVERIFY(showAndSettle(*window));
        ChannelsPanel &panel = window->panel<ChannelsPanel>();
        QCOMPARE(panel.pictures().count(), ChannelsPanel::mostAtOnce);
        for (const int first : {8, 0, 8}) // the last one counts
            panel.setFirstChannel(first);
        QVERIFY(settle(panel));
        QCOMPARE(titlesOf(panel), QStringList({"Channel 8", "Channel 9", "Channel 10"}));
        QVERIFY(!panel.pictures().at(3).picture());
        QTest::mouseClick(panel.pictures().at(2).canvas(), Qt::LeftButton, {}, {20, 20});
        QCOMPARE(window->document().settings().selection.channel, 10);
        QVERIFY(settle(*window));
        panel.setFirstChannel(100); // there is none
        QCOMPARE(panel.firstChannel(), 8);
        panel.setFirstChannel(-1);
        QCOMPARE(panel.firstChannel(), 0);
    }

    void theSessionKeepsThePage()
    {
        const QString session = m_folder.filePath("page.faintline");
        {
            const auto window = newWindow();
            QVERIFY(openAndSettle(*window, recordingOf(m_folder, 11), makeQuick));
            window->panel<ChannelsPanel>().setFirstChannel(8);
            window->document().viewport().zoomTo({10.0, 20.0}, {100.0, 140.0});
            const ViewState kept = window->viewState();
            QCOMPARE(kept.firstChannel, 8);
            window->restore(ViewState());
            QCOMPARE(window->panel<ChannelsPanel>().firstChannel(), 0);
            window->restore(kept);
            QCOMPARE(window->panel<ChannelsPanel>().firstChannel(), 8);
        }
        ViewState view;
        view.firstChannel = 8;
        QCOMPARE(viewFromJson(toJson(view), "page").firstChannel, 8);
        QVERIFY(!toJson(ViewState()).contains("firstChannel"));
    }

    void aMonoRecordingHasOnlyOne()
    {
        const auto window = newWindow();
        window->showView("channels");
        QVERIFY(!sentenceOf(window->panel<ChannelsPanel>()).isEmpty()); // nothing is open
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 1), makeQuick));
        QVERIFY(showAndSettle(*window));
        QCOMPARE(sentenceOf(window->panel<ChannelsPanel>()), QString("This recording has only one channel."));
        QCOMPARE(window->panel<ChannelsPanel>().pictures().count(), 0);
    }

    void aSilentChannelSaysSo()
    {
        const auto samples = std::make_shared<std::vector<float>>(std::size_t(2 * sampleCount));
        std::vector<float> noise(static_cast<std::size_t>(sampleCount));
        Random(3, 1).normals(noise, 0.1f);
        for (std::size_t n = 0; n < noise.size(); ++n)
            (*samples)[2 * n] = noise[n];
        const ArrayRecording recording("made", std::shared_ptr<const float>(samples, samples->data()),
                                       {rate, sampleCount, 2, false, 0.0});
        const QString path = m_folder.filePath("silent.wav");
        writeRecording(recording, path.toStdString());
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, path, makeQuick));
        QVERIFY(showAndSettle(*window));
        QVERIFY(window->panel<ChannelsPanel>().pictures().at(0).picture());
        QVERIFY(!window->panel<ChannelsPanel>().pictures().at(1).picture());
    }

    /// By the View menu, which the palette searches.
    void theMenuOpensIt()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 2), makeQuick));
        QAction *found = nullptr;
        for (const QAction *menu : window->menuBar()->actions())
            for (QAction *action : menu->menu()->actions())
                if (action->text().remove('&') == "Channels side by side")
                    found = action;
        QVERIFY(found && found->isEnabled());
        found->trigger();
        QCoreApplication::processEvents();
        QVERIFY(window->panel<ChannelsPanel>().isVisible());
        QVERIFY(settle(window->panel<ChannelsPanel>()));
    }

    /// Its pictures are made when it is first shown.
    void followsWhatAllPicturesShow()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, recordingOf(m_folder, 2), makeQuick));
        WaterfallView &input = *window->workbench().input();
        input.direction().set(WaterfallView::Orientation::LeftToRight);
        input.display().setColourMap("viridis");
        QVERIFY(showAndSettle(*window));
        LinkedPictures &pictures = window->panel<ChannelsPanel>().pictures();
        QCOMPARE(pictures.at(1).direction().orientation(), WaterfallView::Orientation::LeftToRight);
        QCOMPARE(pictures.at(1).display().colourMap().name(), "viridis");
        QVERIFY(pictures.at(1).y() > pictures.at(0).y());
        for (const int key : {Qt::Key_O, Qt::Key_C, Qt::Key_H})
            QTest::keyClick(&pictures.at(0), Qt::Key(key));
        QCOMPARE(input.direction().orientation(), WaterfallView::Orientation::NewestOnTop);
        QVERIFY(input.display().colourMap().name() != "viridis");
        QVERIFY(input.display().hasHarmonics());
    }

    void isRendered()
    {
        for (const int channels : {1, 2}) {
            const QString out = m_folder.filePath("channels.png");
            QFile::remove(out);
            QProcess process;
            process.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline"),
                          {"render", recordingOf(m_folder, channels), "--view", "channels", "--size", "800x400",
                           "--out", out, "--set", "detector.kind=energy"});
            QVERIFY(process.waitForFinished(patience));
            QCOMPARE(process.readAllStandardError(), QByteArray());
            QCOMPARE(process.exitCode(), 0);
            QCOMPARE(QImage(out).size(), QSize(800, 400));
        }
    }
};

FAINTLINE_WINDOW_TEST(tst_ChannelsPanel)
#include "tst_ChannelsPanel.moc"
