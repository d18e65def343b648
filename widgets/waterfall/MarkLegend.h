#pragma once

#include <QLabel>

namespace faintline {

/// The marks of the pictures with their names, in one line. Each mark is drawn as on a picture, on a dark ground.
class MarkLegend : public QLabel
{
    Q_OBJECT

public:
    explicit MarkLegend(QWidget *parent = nullptr);

protected:
    void changeEvent(QEvent *event) override;

private:
    void drawMarks();
};

} // namespace faintline
