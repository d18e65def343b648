#pragma once

#include "evaluate/sequential/ScanTest.h"

#include <QMap>
#include <QString>
#include <QWidget>

class QLabel;

namespace faintline {

class SettingRow;

/// A form generated from ScanTest::fields(), like SettingsForm for the analysis's settings.
class ScanTestForm : public QWidget
{
    Q_OBJECT

public:
    explicit ScanTestForm(QWidget *parent = nullptr);

    const ScanTest &test() const { return m_test; }
    void setTest(const ScanTest &test); ///< emits nothing
    /// Shows the error under the field that it names, or under the form.
    void showError(const Error &error);
    QWidget *editor(const QString &name) const;

signals:
    void edited();

private:
    void showValues();

    ScanTest m_test;
    QMap<QString, SettingRow *> m_rows;
    QLabel *m_error;
};

} // namespace faintline
