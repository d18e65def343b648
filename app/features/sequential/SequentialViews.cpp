#include "app/features/sequential/SequentialViews.h"

#include "app/base/writeAndReport.h"
#include "app/document/Document.h"
#include "app/document/saveView.h"
#include "app/features/sequential/SequentialTests.h"
#include "app/features/sequential/TrajectoryPage.h"

#include <QFileDialog>
#include <QMenu>

#include <utility>

namespace faintline {

SequentialViews::SequentialViews(const Document &document, const SequentialTests &tests,
                                 const TrajectoryPage &trajectory, QWidget *panel)
    : m_document(document), m_tests(tests), m_trajectory(trajectory), m_panel(panel)
{
}

void SequentialViews::add(QWidget *widget, const QString &title, std::function<std::string()> csv)
{
    m_all.push_back({widget, title, std::move(csv)});
    widget->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(widget, &QWidget::customContextMenuRequested, this, [this, view = m_all.back()](const QPoint &at) {
        QMenu menu;
        menu.addAction(tr("Save picture or numbers…"), this, [this, view] { save(view); });
        menu.exec(view.widget->mapToGlobal(at));
    });
}

void SequentialViews::addActionsTo(QMenu &menu)
{
    for (const View &view : m_all)
        menu.addAction(tr("%1…").arg(view.title), this, [this, view] { save(view); });
}

std::string SequentialViews::provenance(const View &view) const
{
    Json json = {{"version", FAINTLINE_VERSION},
                 {"chart", view.title.toStdString()},
                 {"walk", m_tests.selected()},
                 {"stage", m_tests.stage()},
                 {"axis", m_trajectory.axis()}};
    json["sequential"] = m_tests.isOfScans() ? writeFields(m_tests.test(), ScanTest::fields())
                                             : writeFields(m_tests.test().sprt, SprtSettings::fields());
    if (!m_tests.isOfScans()) {
        const SequentialTests::Selection &selection = m_tests.selection();
        json["recording"] = {{"name", selection.name.toStdString()}};
        json["settings"] = Json::parse(settingsToJson(m_document.settings()));
        json["firstFrame"] = selection.firstFrame;
        json["frameCount"] = selection.frameCount;
        json["firstCell"] = selection.firstCell;
        json["cellCount"] = selection.cellCount;
    }
    return json.dump(2) + "\n";
}

void SequentialViews::save(const View &view)
{
    const QString path = QFileDialog::getSaveFileName(m_panel, tr("Save: %1").arg(view.title),
                                                      QStringLiteral("sequential.png"), saveViewFilter());
    if (!path.isEmpty())
        writeAndReport(*this, path, [&] { saveTo(view, path); });
}

void SequentialViews::saveTo(const View &view, const QString &path) const
{
    saveView(*view.widget, view.csv(), path, provenance(view));
}

} // namespace faintline
