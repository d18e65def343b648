#pragma once

#include "app/base/JobRunner.h"
#include "exchange/writeReport.h"

#include <QObject>
#include <QString>

namespace faintline {

class Document;
class WindowViews;

/// Pictures of the window's views for a report.
std::vector<ReportMaterial::Picture> reportPictures(const WindowViews &views);

/// Adds the ladders, each of which runs the chain again, and writes the page. Throws Error, Cancelled.
void writeReport(const Analysis &analysis, ReportMaterial material, const std::string &path,
                 const RunContext &context = {});

/// Writes reports from the window: the pictures at once, the ladders and the recording's hash on a worker.
class ReportWriter : public QObject
{
    Q_OBJECT

public:
    ReportWriter(const Document &document, const WindowViews &views, QObject *parent = nullptr);

    void write(const QString &path);
    JobRunner &runner() { return m_runner; }

signals:
    void written(const QString &path);
    void failed(const faintline::Error &error);

private:
    const Document &m_document;
    const WindowViews &m_views;
    JobRunner m_runner{this}; ///< last, so that its job ends first
};

} // namespace faintline
