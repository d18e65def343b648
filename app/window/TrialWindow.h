#pragma once

#include "app/document/Document.h"
#include "evaluate/experiments/showTrial.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class ReadOut;
class Workbench;

/// One trial of an experiment in waterfalls of its own, so that what is open stays open: truth, detections and
/// threshold; from here to the next trial, or to the next one that was missed.
class TrialWindow : public QWidget
{
    Q_OBJECT

public:
    explicit TrialWindow(QWidget *parent = nullptr);

    void show(const ShownTrial &trial, const QString &title, const QString &sentence);
    void setBusy(bool isBusy);

    Document &document() { return m_document; }
    Workbench &workbench() { return *m_workbench; }
    QString sentence() const;

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
