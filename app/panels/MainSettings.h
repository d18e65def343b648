#pragma once

#include <QMap>
#include <QWidget>

namespace faintline {

class AnalysisController;
class Document;
class SettingRow;

/// The five settings of lines that are changed first: window, range of slopes, SNR and false alarms per hour. They are
/// those of the pipeline's form, for windows in which that form lies behind another panel. Hidden for pings.
class MainSettings : public QWidget
{
    Q_OBJECT

public:
    MainSettings(Document &document, AnalysisController &controller, QWidget *parent = nullptr);

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
