#pragma once

#include <QLayout>

#include <memory>
#include <vector>

namespace faintline {

/// Widgets side by side, in as many rows as the width requires, so that a row of buttons never needs more room than the
/// widest of them.
class FlowLayout : public QLayout
{
public:
    explicit FlowLayout(QWidget *parent = nullptr);
    ~FlowLayout() override;

    void addItem(QLayoutItem *item) override;
    int count() const override { return int(m_items.size()); }
    QLayoutItem *itemAt(int index) const override;
    QLayoutItem *takeAt(int index) override;
    Qt::Orientations expandingDirections() const override { return {}; }
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override;
    QSize sizeHint() const override; ///< in one row
    QSize minimumSize() const override;
    void setGeometry(const QRect &rect) override;

private:
    int layOut(const QRect &rect, bool isDone) const;

    std::vector<std::unique_ptr<QLayoutItem>> m_items;
};

} // namespace faintline
