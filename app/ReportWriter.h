#pragma once

#include "app/JobRunner.h"
#include "exchange/writeReport.h"

#include <QObject>
#include <QString>

namespace faintline {

class MainWindow;

/// Pictures of what a window shows, for a report.
std::vector<ReportMaterial::Picture> reportPictures(MainWindow &window);

/// Adds the ladders and writes the page. The chain runs again for each of them. Throws Error, Cancelled.
void writeReport(const Analysis &analysis, ReportMaterial material, const std::string &path, const RunContext &context = {});

/// Reports from the window: the pictures at once, the ladders and the recording's hash on a worker.
class ReportWriter : public QObject
{
    Q_OBJECT

public:
    explicit ReportWriter(MainWindow &window);

    void write(const QString &path);
    void cancel() { m_runner.cancel(); }

signals:
    void busyChanged(bool isBusy);
    void progressed(double fraction, const QString &what);
    void written(const QString &path);
    void failed(const faintline::Error &error);

private:
    MainWindow &m_window;
    JobRunner m_runner; ///< last, so that its job ends first
};

} // namespace faintline
