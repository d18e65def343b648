#pragma once

#include <QWidget>

class QAction;
class QLabel;

namespace faintline {

class EventModel;

/// What is known of one event, as the table's columns have it and with the chance that it is noise, and what can be
/// done with it.
class EventCard : public QWidget
{
    Q_OBJECT

public:
    explicit EventCard(const EventModel &model, QWidget *parent = nullptr);

    void setActions(const QList<QAction *> &actions);
    void setRow(int row); ///< of the model; -1 for none
    QString text() const; ///< for tests and screen readers

protected:
    void changeEvent(QEvent *event) override;

private:
    void fill();

    const EventModel &m_model;
    int m_row = -1;
    QLabel *m_title;
    QLabel *m_facts;
    QWidget *m_buttons;
};

} // namespace faintline
