#pragma once

#include "base/Error.h"

#include <QObject>
#include <QString>

#include <functional>
#include <string>
#include <vector>

class QMenu;
class QWidget;

namespace faintline {

class Document;
class SequentialTests;
class TrajectoryPage;

/// The views of sequential tests in files: each as a picture, or its numbers.
///
/// The provenance holds the settings of the test, the selected run and its stage, and the axis of the posterior; for a
/// test on a recording also the recording's name and settings, and the frames and cells that were tested. The numbers
/// of a test on radar scans can be made again from it (replayPicture.h).
class SequentialViews : public QObject
{
    Q_OBJECT

public:
    struct View {
        QWidget *widget;
        QString title;
        std::function<std::string()> csv; ///< its numbers
    };

    /// `panel`: parent of dialogs.
    SequentialViews(const Document &document, const SequentialTests &tests, const TrajectoryPage &trajectory,
                    QWidget *panel);

    /// Adds a view and gives it a context menu for saving it.
    void add(QWidget *widget, const QString &title, std::function<std::string()> csv);
    const std::vector<View> &all() const { return m_all; }
    /// Adds an action for each view that asks for a file and saves the view.
    void addActionsTo(QMenu &menu);

    /// Saves a view as displayed, or its numbers (.csv) with their provenance. Throws Error.
    void saveTo(const View &view, const QString &path) const;

signals:
    void failed(const faintline::Error &error);
    void written(const QString &path);

private:
    void save(const View &view);
    std::string provenance(const View &view) const;

    const Document &m_document;
    const SequentialTests &m_tests;
    const TrajectoryPage &m_trajectory;
    QWidget *m_panel;
    std::vector<View> m_all;
};

} // namespace faintline
