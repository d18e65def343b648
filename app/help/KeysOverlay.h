#pragma once

#include <QPointer>
#include <QWidget>

namespace faintline {

/// Keys and mouse on one sheet over the window; any key or click takes it away.
class KeysOverlay : public QWidget
{
    Q_OBJECT

public:
    explicit KeysOverlay(QWidget *window);

    /// `view`: what is said of it comes first (keysOfView).
    void toggle(const QString &view = {});

protected:
    bool event(QEvent *event) override;
    void paintEvent(QPaintEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void close();

    QPointer<QWidget> m_previousFocus;
    QString m_view;
};

} // namespace faintline
