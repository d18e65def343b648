#pragma once

#include "app/base/Panel.h"
#include "app/features/targets/SceneEditor.h"

#include <vector>

class QComboBox;
class QLabel;
class QPushButton;

namespace faintline {

class ColumnTable;
class PingMap;
class TargetLayer;
class TargetModel;

/// The targets of the open sonar scene, placed on the maps with the mouse and listed with SNR and legs in a table that
/// can be edited. The pings are simulated and analysed again after each change.
///
/// Handles are drawn over the maps while the panel is active.
class TargetsPanel : public Panel
{
    Q_OBJECT

public:
    TargetsPanel(Document &document, const std::vector<PingMap *> &maps, const PingViewports &viewports,
                 QWidget *parent = nullptr);

    SceneEditor &editor() { return *m_editor; }

    /// Writes the scene as JSON, as `faintline-cli simulate` reads it. Throws Error.
    void save(const QString &path) const;

    QSize sizeHint() const override { return {760, 220}; }

    void setSeen(bool isActive) override;

signals:
    void activeChanged(bool isActive);
    void newSceneRequested();

protected:
    /// Escape ends placing before it stops the analysis.
    bool event(QEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void layOut();
    void buildTable();
    void addLayers(PingMap &map);
    void connectInputs();
    void followScene();
    void followSelection();
    void followCurrent(const QModelIndex &current);
    void updateLayers();
    bool takesKey(const QKeyEvent &event) const;
    void pressKey(const QKeyEvent &event);
    void say(const QString &sentence, bool isError);
    void showSentence();
    void chooseFile();

    Document &m_document;
    SceneEditor *m_editor;
    TargetModel *m_model;
    QPushButton *m_place;
    QPushButton *m_addTarget;
    QPushButton *m_addLeg;
    QPushButton *m_remove;
    QPushButton *m_clear;
    QPushButton *m_save;
    QPushButton *m_new;
    QComboBox *m_unit;
    ColumnTable *m_table;
    QLabel *m_sentence;
    std::vector<TargetLayer *> m_layers; ///< of each map, from both sides
    bool m_isActive = false;
};

} // namespace faintline
