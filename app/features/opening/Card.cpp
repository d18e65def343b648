#include "app/features/opening/Card.h"

#include "widgets/base/Theme.h"

#include <QLabel>
#include <QLayout>
#include <QPainter>

namespace faintline {

namespace {

    /// Takes the width it is given; pictures of the start page have no figures that this would distort.
    class StretchedPicture : public QWidget
    {
    public:
        explicit StretchedPicture(const QString &path) : m_picture(path)
        {
            setFixedHeight(m_picture.height());
            setAttribute(Qt::WA_TransparentForMouseEvents);
        }

    protected:
        void paintEvent(QPaintEvent *) override
        {
            QPainter painter(this);
            painter.setRenderHint(QPainter::SmoothPixmapTransform);
            painter.drawPixmap(rect(), m_picture);
        }

    private:
        QPixmap m_picture;
    };

    QLabel *caption(const QString &text, const QFont &font)
    {
        auto *label = new QLabel(text);
        label->setFont(font);
        label->setWordWrap(true);
        label->setAttribute(Qt::WA_TransparentForMouseEvents);
        return label;
    }

} // namespace

Card::Card(const Scenario &scenario, QWidget *parent) : QAbstractButton(parent), m_scenario(scenario)
{
    setText(scenario.title);
    setAccessibleDescription(scenario.sentence);
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::MinimumExpanding);
    setAttribute(Qt::WA_Hover);
    if (!scenario.credit.isEmpty())
        setToolTip(tr("Recording: %1").arg(scenario.credit));

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 8, 12, 8);
    layout->setSpacing(4);
    layout->addWidget(caption(scenario.title, Theme::boldFont(15)));
    layout->addWidget(new StretchedPicture(scenario.picture));
    layout->addWidget(caption(scenario.sentence, Theme::font()));
    if (!scenario.credit.isEmpty())
        layout->addWidget(caption(scenario.credit, Theme::font(11)));
    layout->addStretch();
}

QSize Card::sizeHint() const
{
    return {320, layout()->sizeHint().height()};
}

void Card::paintEvent(QPaintEvent *)
{
    const Theme::Colours &colours = Theme::colours(*this);
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isLit = hasFocus() || underMouse();
    painter.setPen(QPen(isLit ? colours.accent : colours.frame, isLit ? 2.0 : 1.0));
    painter.setBrush(palette().color(QPalette::Base));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1.0, 1.0, -1.0, -1.0), 6.0, 6.0);
}

} // namespace faintline
