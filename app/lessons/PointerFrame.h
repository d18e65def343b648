#pragma once

#include <QPointer>
#include <QWidget>

namespace faintline {

/// A frame around a widget that is being spoken of. It lets every click through and follows the widget wherever it
/// goes.
class PointerFrame : public QWidget
{
    Q_OBJECT

public:
    explicit PointerFrame(QWidget *window);

    void pointAt(QWidget *target); ///< null: at nothing
    QWidget *target() const { return m_target; }

public slots:
    void follow();

protected:
    void paintEvent(QPaintEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    QPointer<QWidget> m_target;
};

} // namespace faintline
