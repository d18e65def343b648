#pragma once

#include "app/base/JobRunner.h"

#include <QTimer>

namespace faintline {

class Document;

/// Measures the area SNR of the measured box (core/inspect/boxLevels.h), from the frames themselves, in the
/// background.
class BoxMeter : public QObject
{
    Q_OBJECT

public:
    explicit BoxMeter(Document &document, QObject *parent = nullptr);

    bool isBusy() const { return m_pause.isActive() || m_runner.isRunning(); }

signals:
    void measured(const QString &note); ///< "area SNR −1.0 dB"

private:
    void follow();
    void measure();

    Document &m_document;
    QTimer m_pause; ///< delays while the box is dragged
    JobRunner m_runner;
};

} // namespace faintline
