#pragma once

#include <QPixmap>
#include <QScrollArea>

#include <vector>

class QBoxLayout;
class QCheckBox;
class QVBoxLayout;

namespace faintline {

/// The key of a chart, with a box for each curve that shows or hides it. It is placed beside the plot or below it,
/// where there is room.
class ChartKey : public QScrollArea
{
    Q_OBJECT

public:
    struct Entry {
        QString name;
        QPixmap sample;
        bool isShown = true;
    };

    explicit ChartKey(QWidget *parent = nullptr);

    void setEntries(const std::vector<Entry> &entries);
    void setShown(std::size_t entry, bool isShown);
    /// Print mode: no boxes and no hidden curves.
    void setPrinted(bool isPrinted);

    /// Places the key in a row with the plot that fills a widget of that size.
    void placeIn(QBoxLayout &row, const QSize &size);

signals:
    void toggled(std::size_t entry, bool isShown);

private:
    void makeBoxes(const std::vector<Entry> &entries);

    QWidget *m_content;
    QVBoxLayout *m_layout;
    std::vector<QCheckBox *> m_boxes;
    bool m_isPrinted = false;
};

} // namespace faintline
