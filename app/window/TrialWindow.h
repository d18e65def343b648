#pragma once

#include "app/document/Document.h"
#include "evaluate/experiments/showTrial.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class ReadOut;
class Workbench;

/// One trial of an experiment in its own waterfalls, independent of the open document: truth, detections and threshold,
/// with buttons for the previous and the next trial and the next miss.
class TrialWindow : public QWidget
{
    Q_OBJECT

public:
    explicit TrialWindow(QWidget *parent = nullptr);

    void show(const ShownTrial &trial, const QString &title, const QString &sentence);
    void setBusy(bool isBusy);

    Document &document() { return m_document; }
    Workbench &workbench() { return *m_workbench; }

signals:
    void stepRequested(int trials, bool onlyMissed);

protected:
    void keyPressEvent(QKeyEvent *event) override;

private:
    Document m_document;
    Workbench *m_workbench;
    ReadOut *m_readOut;
    QLabel *m_sentence;
    QPushButton *m_previous;
    QPushButton *m_next;
    QPushButton *m_nextMissed;
};

} // namespace faintline
