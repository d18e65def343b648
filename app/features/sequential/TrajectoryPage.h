#pragma once

#include "base/Axis.h"

#include <QSplitter>

#include <string>

class QComboBox;

namespace faintline {

class CellPicture;
class SequentialTests;
struct PosteriorPicture;

/// The posterior of the target's position in the selected run of a sequential test, stage by stage along one axis, and
/// the scan of the selected stage, with the truth and the most probable trajectory over both.
class TrajectoryPage : public QSplitter
{
    Q_OBJECT

public:
    explicit TrajectoryPage(SequentialTests &tests, QWidget *parent = nullptr);

    CellPicture &posterior() { return *m_posterior; }
    CellPicture &scan() { return *m_scan; }
    /// Index of the displayed axis of the posterior.
    int axis() const;
    void showAxis(int axis);

    /// The numbers of both pictures; empty if there are none.
    std::string posteriorNumbers() const;
    std::string scanNumbers() const;

    /// Clears the page when tests restart.
    void clear();

private:
    void showInspection();
    void showScan();
    void showStage();
    const PosteriorPicture *shownPosterior() const;
    Axis cellAxis(const PosteriorPicture &picture) const;

    SequentialTests &m_tests;
    QComboBox *m_axis; ///< of the posterior
    CellPicture *m_posterior;
    CellPicture *m_scan;
};

} // namespace faintline
