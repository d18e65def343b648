#include "app/features/targets/TargetsPanel.h"

#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "app/features/targets/TargetModel.h"
#include "base/files/AtomicFile.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarView.h"
#include "widgets/pings/TargetLayer.h"
#include "widgets/table/ColumnTable.h"

#include <QComboBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QUrl>
#include <QVBoxLayout>

namespace faintline {

TargetsPanel::TargetsPanel(Document &document, const std::vector<PingMap *> &maps, const PingViewports &viewports,
                           QWidget *parent)
    : Panel(parent), m_document(document), m_editor(new SceneEditor(document, viewports, this)),
      m_model(new TargetModel(*m_editor, this)), m_place(new QPushButton(tr("Place on the map"))),
      m_addTarget(new QPushButton(tr("Target at cursor"))), m_addLeg(new QPushButton(tr("Leg to cursor"))),
      m_remove(new QPushButton(tr("Remove target"))), m_clear(new QPushButton(tr("Remove all"))),
      m_save(new QPushButton(tr("Save scene…"))), m_new(new QPushButton(tr("New scene"))), m_unit(new QComboBox),
      m_table(new ColumnTable(tr("Targets and their legs"), m_model)), m_sentence(panelSentence())
{
    m_place->setCheckable(true);
    m_place->setToolTip(tr("Click a map to place a target in the ping shown; drag to draw its first leg"));
    m_addTarget->setToolTip(tr("Place a target at the cursor, which the arrow keys move, in the ping shown"));
    m_addLeg->setToolTip(tr("Add a leg from the end of the selected target to the cursor"));
    m_save->setToolTip(tr("Save the scene as JSON, for faintline-cli simulate"));
    m_new->setToolTip(tr("Open a scene of noise without targets"));
    m_unit->addItem(tr("m/s and °/s"), int(RateUnit::PerSecond));
    m_unit->addItem(tr("cells and beams per ping"), int(RateUnit::PerPing));
    m_unit->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_unit->setAccessibleName(tr("Unit of the rates"));
    m_unit->setToolTip(tr("Unit in which rates are displayed and set"));
    buildTable();
    layOut();
    for (PingMap *map : maps)
        addLayers(*map);
    connectInputs();
    followScene();
}

void TargetsPanel::layOut()
{
    auto *buttons = new QGridLayout;
    buttons->setSpacing(4);
    buttons->addWidget(m_place, 0, 0, 1, 2);
    buttons->addWidget(m_addTarget, 1, 0);
    buttons->addWidget(m_addLeg, 1, 1);
    buttons->addWidget(m_remove, 2, 0);
    buttons->addWidget(m_clear, 2, 1);
    buttons->addWidget(m_save, 3, 0);
    buttons->addWidget(m_new, 3, 1);
    buttons->addWidget(m_unit, 4, 0, 1, 2);
    buttons->setRowStretch(5, 1);
    auto *right = new QVBoxLayout;
    right->setSpacing(4);
    right->addWidget(m_table, 1);
    right->addWidget(m_sentence);
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 6, 8, 6);
    layout->setSpacing(8);
    layout->addLayout(buttons);
    layout->addLayout(right, 1);
    setTabOrder(m_unit, m_table);
}

void TargetsPanel::buildTable()
{
    constexpr int rowHeight = 22;
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setTabKeyNavigation(false);
    m_table->setSmall(rowHeight);
    m_table->setSelectionBehavior(QAbstractItemView::SelectItems);
    m_table->setShowGrid(true);
    m_table->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed
                             | QAbstractItemView::AnyKeyPressed);
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_table->setMinimumHeight(3 * rowHeight);
    m_table->installEventFilter(this);
}

void TargetsPanel::addLayers(PingMap &map)
{
    for (TargetLayer *layer : {new TargetLayer(*map.plane()), new TargetLayer(*map.polar())}) {
        m_layers.push_back(layer); // owned by its view
        connect(layer, &TargetLayer::pressed, m_editor, &SceneEditor::press);
        connect(layer, &TargetLayer::dragged, m_editor, &SceneEditor::drag);
        connect(layer, &TargetLayer::released, m_editor, &SceneEditor::release);
        connect(layer, &TargetLayer::abandoned, m_editor, &SceneEditor::abandon);
        connect(layer, &TargetLayer::removeRequested, m_editor, &SceneEditor::removeSelected);
        connect(layer, &TargetLayer::placingEnded, m_editor, [this] { m_editor->setPlacing(false); });
    }
}

void TargetsPanel::connectInputs()
{
    connect(m_editor, &SceneEditor::mapChanged, this, &TargetsPanel::updateLayers);
    connect(m_place, &QPushButton::toggled, m_editor, &SceneEditor::setPlacing);
    connect(m_addTarget, &QPushButton::clicked, m_editor, &SceneEditor::addTarget);
    connect(m_addLeg, &QPushButton::clicked, m_editor, &SceneEditor::addLeg);
    connect(m_remove, &QPushButton::clicked, m_editor, &SceneEditor::removeSelected);
    connect(m_clear, &QPushButton::clicked, m_editor, &SceneEditor::clear);
    connect(m_save, &QPushButton::clicked, this, &TargetsPanel::chooseFile);
    connect(m_new, &QPushButton::clicked, this, &TargetsPanel::newSceneRequested);
    connect(m_unit, &QComboBox::activated, this,
            [this] { m_editor->setRateUnit(RateUnit(m_unit->currentData().toInt())); });

    connect(m_editor, &SceneEditor::sceneChanged, this, &TargetsPanel::followScene);
    connect(m_editor, &SceneEditor::selectionChanged, this, &TargetsPanel::followSelection);
    connect(m_editor, &SceneEditor::rateUnitChanged, this,
            [this] { m_unit->setCurrentIndex(m_unit->findData(int(m_editor->rateUnit()))); });
    connect(m_editor, &SceneEditor::placingChanged, this, [this](bool isPlacing) {
        m_place->setChecked(isPlacing);
        for (TargetLayer *layer : m_layers)
            layer->setPlacing(isPlacing);
        showSentence();
    });
    const auto refuse = [this](const Error &error) { say(messageText(error.what()), true); };
    connect(m_editor, &SceneEditor::refused, this, refuse);
    connect(m_model, &TargetModel::refused, this, refuse);
    connect(m_model, &TargetModel::accepted, this, &TargetsPanel::showSentence);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this, &TargetsPanel::followCurrent);
    connect(&m_document, &Document::opened, this, &TargetsPanel::updateLayers);
    connect(&m_document, &Document::analysisChanged, this, &TargetsPanel::updateLayers);
}

void TargetsPanel::setSeen(bool isActive)
{
    if (isActive == m_isActive)
        return;
    m_isActive = isActive;
    if (!isActive) {
        m_editor->abandon();
        m_editor->setPlacing(false);
    }
    followScene();
    emit activeChanged(isActive);
}

/// Without an analysis the maps have no axes to place anything on.
void TargetsPanel::updateLayers()
{
    const bool isShown = m_isActive && m_editor->scene() && m_editor->isOnMap() && m_document.analysis();
    for (TargetLayer *layer : m_layers)
        layer->setActive(isShown);
}

void TargetsPanel::followScene()
{
    const PingScene *scene = m_editor->scene();
    const bool hasTargets = scene && !scene->targets.empty();
    for (QPushButton *button : {m_place, m_addTarget, m_save})
        button->setEnabled(scene != nullptr);
    m_clear->setEnabled(hasTargets);
    m_unit->setEnabled(scene != nullptr);
    if (m_isActive) {
        const std::vector<TargetShape> shapes = m_editor->shapes();
        for (TargetLayer *layer : m_layers) {
            layer->setShapes(shapes);
            layer->setReach(m_editor->reach());
        }
    }
    updateLayers();
    followSelection();
    showSentence();
}

void TargetsPanel::followSelection()
{
    const TargetHandle &selected = m_editor->selected();
    for (TargetLayer *layer : m_layers)
        layer->setSelected(selected);
    m_addLeg->setEnabled(!selected.isNone());
    m_remove->setEnabled(!selected.isNone());
    m_remove->setText(selected.corner > 0 ? tr("Remove leg") : tr("Remove target"));
    if (m_model->handleAt(m_table->sourceIndex(m_table->currentIndex())) == selected)
        return;
    const QSignalBlocker blocker(m_table->selectionModel());
    const auto column = selected.corner > 0 ? TargetColumn::RangeRate : TargetColumn::Snr;
    m_table->setCurrentIndex(m_table->shownIndex(m_model->indexOf(selected, int(column))));
    m_table->viewport()->update();
}

void TargetsPanel::followCurrent(const QModelIndex &current)
{
    if (current.isValid())
        m_editor->select(m_model->handleAt(m_table->sourceIndex(current)));
    showSentence();
}

void TargetsPanel::say(const QString &sentence, bool isError)
{
    QPalette colours = palette();
    if (isError)
        colours.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_sentence->setPalette(colours);
    m_sentence->setText(sentence);
}

void TargetsPanel::showSentence()
{
    if (!m_editor->scene())
        return say(tr("Targets can be placed in simulated scenes of sonar pings. Open one, or press New scene."),
                   false);
    if (!m_editor->reach().empty())
        return say(tr("Dotted: as far as the fastest target gets in this leg that the model follows."), false);
    if (m_editor->isPlacing())
        return say(
            tr("Click a map to place a target, drag to draw its leg. Drag from its end, or Shift+click, to add a "
               "leg. Escape ends placing."),
            false);
    say(m_editor->scene()->targets.empty()
            ? tr("No targets. Press Place on the map, or Target at cursor.")
            : tr("Drag a corner on the map, or type into a cell. Delete removes the selected leg or target."),
        false);
}

void TargetsPanel::save(const QString &path) const
{
    if (const PingScene *scene = m_editor->scene())
        writeTextFile(pathBytes(path), toJson(*scene).dump(2) + "\n", Durability::Machine, Written::Document);
}

void TargetsPanel::chooseFile()
{
    const QString beside = nameBeside(m_document.sourcePath(), QStringLiteral("-scene.json"));
    const QString path = pathOf(
        QFileDialog::getSaveFileUrl(this, tr("Save the scene"), QUrl::fromLocalFile(beside), tr("Scenes (*.json)")));
    if (!path.isEmpty())
        writeAndReport(*this, path, [&] { save(path); });
}

/// Keys that the table takes from the window's shortcuts: what begins a number, and those of editing.
bool TargetsPanel::takesKey(const QKeyEvent &event) const
{
    if (event.modifiers() & ~Qt::KeypadModifier)
        return false;
    const QString text = event.text();
    return event.key() == Qt::Key_Delete || event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter
           || (event.key() == Qt::Key_Escape && m_editor->isPlacing())
           || (text.size() == 1 && (text[0].isDigit() || text[0] == QLatin1Char('-') || text[0] == QLatin1Char('.')));
}

void TargetsPanel::pressKey(const QKeyEvent &event)
{
    if (event.key() == Qt::Key_Delete)
        m_editor->removeSelected();
    else if (event.key() == Qt::Key_Escape)
        m_editor->setPlacing(false);
    else if (m_table->model()->flags(m_table->currentIndex()).testFlag(Qt::ItemIsEditable))
        m_table->edit(m_table->currentIndex());
}

bool TargetsPanel::event(QEvent *event)
{
    const bool isOfKey = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
    if (!isOfKey || static_cast<QKeyEvent *>(event)->key() != Qt::Key_Escape || !m_editor->isPlacing())
        return QWidget::event(event);
    if (event->type() == QEvent::KeyPress)
        m_editor->setPlacing(false);
    event->accept();
    return true;
}

bool TargetsPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress)
        return QWidget::eventFilter(watched, event);
    const auto &key = *static_cast<QKeyEvent *>(event);
    const bool isText = key.text().size() == 1 && key.text()[0].isPrint();
    if (!takesKey(key) || (isText && event->type() == QEvent::KeyPress)) // the table itself begins to edit with text
        return QWidget::eventFilter(watched, event);
    if (event->type() == QEvent::KeyPress)
        pressKey(key);
    event->accept();
    return true;
}

} // namespace faintline
