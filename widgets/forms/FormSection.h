#pragma once

#include <QWidget>

class QToolButton;
class QVBoxLayout;

namespace faintline {

/// A heading that folds away what stands under it, and within that a second fold, "More", for what is seldom used.
class FormSection : public QWidget
{
    Q_OBJECT

public:
    explicit FormSection(const QString &heading, QWidget *parent = nullptr);

    void addRow(QWidget *row, bool isSeldomUsed);

    void setOpen(bool isOpen);
    void setMoreOpen(bool isOpen);
    bool isOpen() const;

    /// Opens whatever hides the row.
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
