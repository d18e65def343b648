#pragma once

#include <QMap>
#include <QWidget>

#include <vector>

namespace faintline {

class AnalysisController;
class Document;
class SettingRow;

/// Settings of lines that are changed first, as rows of the pipeline's form, where that form is not seen. Hidden for
/// pings.
class MainSettings : public QWidget
{
    Q_OBJECT

public:
    /// The five most frequent ones: window, range of slopes, SNR and false alarms per hour.
    static const std::vector<const char *> &few();
    /// With part, band, window's shape, detector and strong lines: a dozen.
    static const std::vector<const char *> &dozen();

    MainSettings(Document &document, AnalysisController &controller, const std::vector<const char *> &names,
                 QWidget *parent = nullptr);

    /// Whether they are settings of the open source.
    bool isApplicable() const;

signals:
    void applicableChanged();

private:
    void showSettings();
    void showUsedSlopes();

    Document &m_document;
    AnalysisController &m_controller;
    QMap<QString, SettingRow *> m_rows;
};

} // namespace faintline
