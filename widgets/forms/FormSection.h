#pragma once

#include <QWidget>

class QToolButton;
class QVBoxLayout;

namespace faintline {

/// A heading that folds its content, with a second fold, "More", for seldom used rows.
class FormSection : public QWidget
{
    Q_OBJECT

public:
    explicit FormSection(const QString &heading, QWidget *parent = nullptr);

    void addRow(QWidget *row, bool isAdvanced);

    void setOpen(bool isOpen);
    void setMoreOpen(bool isOpen);

    /// "More" is offered if one of its rows is shown.
    void offerMore();

    /// Unfolds everything that hides the row.
    void reveal(QWidget *row);

private:
    QToolButton *m_heading;
    QToolButton *m_more;
    QWidget *m_body;
    QWidget *m_moreBody;
    QVBoxLayout *m_rows;
    QVBoxLayout *m_moreRows;
};

} // namespace faintline
