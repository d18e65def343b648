#pragma once

#include "app/document/Document.h"
#include "scene/editTargets.h"
#include "widgets/pings/PingViewports.h"
#include "widgets/pings/TargetShape.h"

#include <QObject>

#include <optional>
#include <vector>

namespace faintline {

/// The open scene of sonar pings under edit: placing, moving and removing targets and legs.
///
/// The document owns the scene; every change becomes one undoable step of it, after which the pings are simulated and
/// analysed again. This object adds the selection, and during a drag a draft of the scene, which the document gets when
/// the mouse is released.
class SceneEditor : public QObject
{
    Q_OBJECT

public:
    using Place = PingMarks::Place;

    /// `viewports`: the ping shown, in which targets are placed, and the cursor.
    SceneEditor(Document &document, const PingViewports &viewports, QObject *parent = nullptr);

    /// The scene with the change in progress; null if the open source is not a simulated scene of pings.
    const PingScene *scene() const;
    std::vector<TargetShape> shapes() const;
    /// While a leg is drawn: outline of the places where it can end if the model is to follow it, at a constant rate.
    std::vector<Place> reach() const;

    const TargetHandle &selected() const { return m_selected; }
    void select(const TargetHandle &handle);

    bool isPlacing() const { return m_isPlacing; }
    void setPlacing(bool isPlacing);

    /// The unit in which rates are displayed and set.
    RateUnit rateUnit() const { return m_unit; }
    void setRateUnit(RateUnit unit);

    /// One undoable step. Throws Error as `checkScene` does.
    void replace(const PingScene &after, const QString &text);

    // ---- a gesture on the map ------------------------------------------------------------------------------------

    /// On a corner: selects it, and moves it when dragged. While placing, a drag from a target's last corner draws
    /// another leg; a press beside all corners (`handle` none) places a target, or with `addsLeg` ends a new leg of the
    /// selected one there.
    void press(const TargetHandle &handle, const Place &place, bool addsLeg);
    void drag(const Place &place);
    void release();
    void abandon();

    // ---- the same by command, at the cursor ----------------------------------------------------------------------

    void addTarget();
    void addLeg();
    /// The selected leg, or the target if its start is selected.
    void removeSelected();
    void clear();

    /// Whether the maps show range and bearing, on which targets are placed.
    bool isOnMap() const { return m_viewports.plane().along == 0 && m_viewports.plane().across == 1; }

signals:
    void mapChanged(); ///< they may show other axes
    void sceneChanged();
    void selectionChanged();
    void placingChanged(bool isPlacing);
    void rateUnitChanged();
    void refused(const faintline::Error &error); ///< a change that is not possible

private:
    enum class Gesture { None, Move, Draw };

    Place cursor() const;
    PingScene withTargetAt(const Place &place) const;
    PingScene withLeg(const PingScene &scene, int target, const Place &place) const;
    void keepSelection();
    void setDraft(PingScene draft);
    /// Makes the draft a step of the document.
    void commit(const QString &text);

    Document &m_document;
    const PingViewports &m_viewports;
    TargetHandle m_selected;
    bool m_isPlacing = false;
    RateUnit m_unit = RateUnit::PerSecond;

    Gesture m_gesture = Gesture::None;
    TargetHandle m_held; ///< the corner that is moved, or from which a leg is drawn
    PingScene m_base;    ///< the scene to which the drag applies
    QString m_text;      ///< of its undoable step
    std::optional<PingScene> m_draft;
};

} // namespace faintline
