#include "widgets/plot/ChartFigure.h"

#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/plot/ChartPlot.h"

#include <qwt_plot.h>
#include <qwt_plot_renderer.h>

#include <QLabel>
#include <QPainter>
#include <QVBoxLayout>

namespace faintline {

namespace {

    constexpr QSize chartSize(760, 460);
    constexpr QSize leastPlotSize(760, 240);

    /// Records a plot in light colours, at least at page size.
    QPicture recorded(QWidget &plot)
    {
        const QSize before = plot.size();
        const bool hadPalette = plot.testAttribute(Qt::WA_SetPalette);
        const QPalette palette = plot.palette();
        plot.setPalette(Theme::palette(Theme::Kind::Light));
        plot.resize(before.expandedTo(leastPlotSize));
        QPicture picture;
        QPainter painter(&picture);
        if (auto *chart = qobject_cast<QwtPlot *>(&plot)) { // rendered as a widget, titles and labels would be clipped
            QwtPlotRenderer renderer;
            renderer.setDiscardFlag(QwtPlotRenderer::DiscardBackground);
            renderer.render(chart, &painter, chart->rect());
        } else {
            plot.render(&painter);
        }
        painter.end();
        picture.setBoundingRect(plot.rect());
        plot.resize(before);
        plot.setPalette(hadPalette ? palette : QPalette());
        return picture;
    }

    class PictureWidget : public QWidget
    {
    public:
        explicit PictureWidget(QPicture picture) : m_picture(std::move(picture))
        {
            setFixedSize(m_picture.boundingRect().size());
        }

    protected:
        void paintEvent(QPaintEvent *) override
        {
            QPainter painter(this);
            painter.drawPicture(0, 0, m_picture);
        }

    private:
        QPicture m_picture;
    };

} // namespace

ChartFigure::ChartFigure(const ChartPlot &chart, const QString &caption)
{
    auto *copy = new ChartPlot;
    copy->setFixedSize(chartSize);
    copy->setChart(chart.chart());
    copy->setMarks(chart.marks());
    for (std::size_t curve = 0; curve < chart.chart().curves.size(); ++curve)
        copy->setShown(curve, chart.isShown(curve));
    copy->setPrinted(true);
    setAccessibleName(chart.accessibleName());
    layOut(copy, caption);
}

ChartFigure::ChartFigure(QWidget &plot, const QString &caption)
{
    setAccessibleName(plot.accessibleName());
    layOut(new PictureWidget(recorded(plot)), caption);
}

void ChartFigure::layOut(QWidget *figure, const QString &caption)
{
    setPalette(Theme::palette(Theme::Kind::Light));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    auto *text = plainLabel();
    text->setText(caption);
    text->setWordWrap(true);
    text->setFont(Theme::font(12));
    text->setFixedWidth(figure->width() - 24);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 4, 0, 10);
    layout->addWidget(figure);
    layout->addWidget(text, 0, Qt::AlignHCenter);
    text->setVisible(!caption.isEmpty());
    setAttribute(Qt::WA_DontShowOnScreen);
    show(); // triggers the layout
    const int width = figure->width();
    setFixedSize(width, layout->hasHeightForWidth() ? layout->totalHeightForWidth(width) : layout->sizeHint().height());
}

} // namespace faintline
