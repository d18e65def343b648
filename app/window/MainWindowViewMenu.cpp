// The View menu of the main window: zoom, axes, marks, layers, panels, themes.

#include "app/window/MainWindow.h"

#include "app/control/OutputLayers.h"
#include "app/control/PlainInput.h"
#include "app/window/Panels.h"
#include "app/workspace/Workbench.h"
#include "widgets/waterfall/waterfallCommands.h"

#include <QActionGroup>
#include <QMenu>
#include <QMenuBar>

namespace faintline {

void MainWindow::addFrequencyActions(QMenu &menu)
{
    Viewport *viewport = &m_document.viewport();
    QAction *logarithmic = addViewAction(menu, tr("&Logarithmic frequency"), QKeySequence(Qt::SHIFT | Qt::Key_L), {});
    logarithmic->setCheckable(true);
    logarithmic->setToolTip(
        tr("Show frequencies on a logarithmic scale; not for I/Q, whose frequencies may be negative"));
    const auto showScale = [viewport, logarithmic] { logarithmic->setChecked(viewport->isLogarithmic()); };
    connect(viewport, &Viewport::scaleChanged, logarithmic, showScale);
    connect(logarithmic, &QAction::triggered, viewport, [viewport, showScale](bool isOn) {
        viewport->setLogarithmic(isOn);
        showScale();
    });
    QAction *radio = addViewAction(menu, tr("&Radio frequency"), QKeySequence(Qt::SHIFT | Qt::Key_R), {});
    radio->setCheckable(true);
    radio->setToolTip(tr("Label the frequency axis with the recording's centre frequency added, where it is known"));
    connect(radio, &QAction::triggered, m_workbench, &Workbench::setRadioAxis);
    connect(&menu, &QMenu::aboutToShow, radio, [this, radio] { radio->setChecked(m_workbench->isRadioAxis()); });
}

void MainWindow::buildViewMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&View"));
    WaterfallView *input = m_workbench->input();
    WaterfallView *output = m_workbench->output();
    Viewport *viewport = &m_document.viewport();
    addViewAction(*menu, tr("Show &all"), Qt::Key_0, [viewport] { viewport->showAll(); });
    addViewAction(*menu, tr("Zoom &back"), Qt::Key_Backspace, [viewport] { viewport->zoomBack(); });
    addViewAction(*menu, tr("To the &newest frames"), Qt::Key_End, [this, viewport] {
        if (m_document.isLive())
            viewport->setFollowing(true);
    })->setToolTip(tr("While listening, go to the newest frames"));
    menu->addSeparator();
    addViewAction(*menu, tr("Next &orientation"), Qt::Key_O, [this] { bench().cycleOrientation(); });
    addFrequencyActions(*menu);
    addViewAction(*menu, tr("Next &colour map"), Qt::Key_C, [this] { bench().cycleColourMap(); });
    addViewAction(*menu, tr("A&utomatic range"), Qt::Key_A, [this] { bench().setAutomaticRange(); });
    connect(&m_workbench->plainInput(), &PlainInput::failed, this, &MainWindow::showError);
    menu->addAction(m_workbench->plainInput().action());
    m_viewActions.push_back(m_workbench->plainInput().action());
    menu->addSeparator();
    addViewAction(*menu, tr("&Measure a box"), Qt::Key_M, [output] { output->setMeasuring(!output->isMeasuring()); });
    QAction *harmonics = m_harmonicsAction = addViewAction(*menu, tr("&Harmonics"), Qt::Key_H, {});
    harmonics->setCheckable(true);
    connect(harmonics, &QAction::toggled, input, &WaterfallView::setHarmonics);
    connect(harmonics, &QAction::toggled, output, &WaterfallView::setHarmonics);
    connect(output, &WaterfallView::harmonicsChanged, harmonics, &QAction::setChecked);
    connect(input, &WaterfallView::harmonicsChanged, harmonics, &QAction::setChecked);
    QAction *sidebands = addViewAction(*menu, tr("S&idebands"), Qt::Key_I, {});
    sidebands->setCheckable(true);
    connect(sidebands, &QAction::toggled, output, &WaterfallView::setSidebands);
    connect(output, &WaterfallView::sidebandsChanged, sidebands,
            [sidebands](double hz) { sidebands->setChecked(hz > 0.0); });
    addViewAction(*menu, tr("Cursor to the pea&k nearby"), Qt::Key_K,
                  [input, output] { (input->hasFocus() ? input : output)->moveCursorToPeak(); });
    addViewAction(*menu, tr("S&pectrum"), QKeySequence(Qt::SHIFT | Qt::Key_S), [this] {
        showView(QStringLiteral("spectrum"));
    })->setToolTip(tr("Spectrum at the cursor, and mean spectrum of the visible part"));
    addViewAction(*menu, tr("C&hannels side by side"), {}, [this] {
        showView(QStringLiteral("channels"));
    })->setToolTip(tr("The input of each channel of the recording; a click selects the channel that is analysed"));
    menu->addSeparator();
    QMenu *picture = menu->addMenu(tr("P&icture"));
    connect(picture, &QMenu::aboutToShow, this, [picture, output] {
        picture->clear();
        addCommands(*picture, *output);
    });
    addAction(addViewAction(*menu, tr("What was &found, or the statistic D"), Qt::Key_F,
                            [layers = &m_workbench->layers()] { layers->toggleFound(); }));
    addLayerMenu(*menu);
    m_regulationAction = addViewAction(*menu, tr("Share of &resets and ln K over time"), {}, {});
    m_regulationAction->setCheckable(true);
    m_regulationAction->setChecked(true);
    m_regulationAction->setToolTip(tr("How much the detector forgets, below the pictures"));
    connect(m_regulationAction, &QAction::toggled, m_workbench, &Workbench::setRegulationWanted);
    addSnrMenu(*menu);
    m_panelsMenu = menu->addMenu(tr("&Panels"));
    m_panelsMenu->addActions(m_panels->toggleActions());
    QMenu *layouts = menu->addMenu(tr("La&yout"));
    for (const QString &name : Panels::layoutNames())
        addViewAction(*layouts, name, {}, [this, name] { takeLayout(name); });
    addViewAction(*menu, tr("Ma&ximise panel"), Qt::Key_F11, [this] {
        m_panels->toggleMaximised();
    })->setToolTip(tr("Give the whole window to the panel that has the focus, or put it back"));
    addPresentation(*layouts);
    addAction(m_presentAction); // also while the menu bar is hidden
    addThemeMenu(*menu);
}

void MainWindow::addPresentation(QMenu &menu)
{
    m_presentAction = addViewAction(menu, tr("&Lecture: the pictures alone, full screen"), Qt::Key_F5, {});
    m_presentAction->setCheckable(true);
    connect(m_presentAction, &QAction::toggled, m_panels, &Panels::setPresenting);
    // Escape leaves a presentation; otherwise it stops the running job.
    auto *leave = new QAction(tr("Leave the presentation"), this);
    addAction(leave);
    connect(leave, &QAction::triggered, this, [this] { m_presentAction->setChecked(false); });
    connect(m_presentAction, &QAction::toggled, leave, [this, leave](bool isPresenting) {
        (isPresenting ? m_stopAction : leave)->setShortcut({});
        (isPresenting ? leave : m_stopAction)->setShortcut(Qt::Key_Escape);
    });
}

void MainWindow::addSnrMenu(QMenu &menu)
{
    QMenu *choices = menu.addMenu(tr("S&NR in the bandwidth"));
    choices->setToolTipsVisible(true);
    auto *group = new QActionGroup(choices);
    const auto add = [&](const QString &text, double hz) {
        QAction *action = choices->addAction(text, this, [this, hz] { setSnrBandwidth(hz); });
        action->setCheckable(true);
        action->setActionGroup(group);
        action->setChecked(hz == m_memory.snrBandwidthHz());
        return action;
    };
    add(tr("of one &bin, as detected"), 0.0);
    add(tr("of &1 Hz"), 1.0);
    add(tr("of &500 Hz"), 500.0);
    add(tr("of &2500 Hz"), 2500.0)->setToolTip(tr("As WSJT-X gives it"));
    setSnrBandwidth(m_memory.snrBandwidthHz());
}

void MainWindow::addThemeMenu(QMenu &menu)
{
    QMenu *themes = menu.addMenu(tr("&Theme"));
    auto *group = new QActionGroup(themes);
    const auto addTheme = [&](const QString &text, Theme::Kind kind) {
        QAction *action = themes->addAction(text, this, [this, kind] { setTheme(kind); });
        action->setCheckable(true);
        action->setActionGroup(group);
        action->setChecked(Theme::kind(palette()) == kind);
    };
    addAction(themes->addAction(tr("Light &or dark"), QKeySequence(Qt::Key_F6), this, [this] {
        setTheme(Theme::kind(palette()) == Theme::Kind::Light ? Theme::Kind::Dark : Theme::Kind::Light);
    }));
    themes->addSeparator();
    addTheme(tr("&Light"), Theme::Kind::Light);
    addTheme(tr("&Dark"), Theme::Kind::Dark);
    addTheme(tr("&High contrast"), Theme::Kind::HighContrast);
}

void MainWindow::addLayerMenu(QMenu &menu)
{
    OutputLayers *layers = &m_workbench->layers();
    QMenu *choices = menu.addMenu(tr("&Output layer"));
    auto *group = new QActionGroup(choices);
    const std::pair<QString, OutputLayer> all[]{{tr("Layer: &statistic D"), OutputLayer::Statistic},
                                                {tr("Layer: winning s&lope or range rate"), OutputLayer::Rate},
                                                {tr("Layer: winning &bearing rate"), OutputLayer::SecondRate},
                                                {tr("Layer: path &age since the last reset"), OutputLayer::Age},
                                                {tr("Layer: &resets"), OutputLayer::Reset},
                                                {tr("Layer: &inhibited cells"), OutputLayer::Inhibited},
                                                {tr("Layer: &presence of the tracks"), OutputLayer::Presence}};
    for (const auto &[text, layer] : all) {
        QAction *action = addViewAction(*choices, text, {}, [layers, layer = layer] { layers->setLayer(layer); });
        action->setCheckable(true);
        action->setActionGroup(group);
        const auto check = [layers, action, layer = layer] {
            action->setChecked(layers->layer() == layer);
            action->setVisible(layers->isOffered(layer));
        };
        connect(layers, &OutputLayers::layerChanged, action, check);
        connect(&m_document, &Document::opened, action, check);
        check();
    }
    choices->addSeparator();
    addAction(addViewAction(*choices, tr("Layer: &next"), Qt::Key_V, [layers] { layers->cycleLayer(); }));
    QAction *overlay =
        addViewAction(*choices, tr("Layer &over the statistic"), QKeySequence(Qt::SHIFT | Qt::Key_V), {});
    overlay->setCheckable(true);
    connect(overlay, &QAction::toggled, layers, &OutputLayers::setOverlay);
    connect(layers, &OutputLayers::layerChanged, overlay,
            [layers, overlay] { overlay->setChecked(layers->isOverlay()); });
    addAction(overlay);
}

} // namespace faintline
