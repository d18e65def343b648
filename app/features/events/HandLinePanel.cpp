#include "app/features/events/HandLinePanel.h"

#include "base/logmath.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/table/ColumnTable.h"
#include "widgets/waterfall/HandLine.h"

#include <QEvent>
#include <QGridLayout>
#include <QHeaderView>
#include <QHideEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Hides what is below it until the user has decided.
    class Cover : public QWidget
    {
    public:
        Cover(QWidget &over, const QString &sentence) : QWidget(&over), m_sentence(sentence)
        {
            over.installEventFilter(this);
            setGeometry(over.rect());
            setAccessibleName(sentence);
            show();
        }

    protected:
        void paintEvent(QPaintEvent *) override
        {
            QPainter painter(this);
            painter.fillRect(rect(), palette().color(QPalette::Window));
            painter.setPen(Theme::colours(*this).faintText);
            painter.setFont(Theme::font(15));
            painter.drawText(rect().adjusted(24, 0, -24, 0), Qt::AlignCenter | Qt::TextWordWrap, m_sentence);
        }
        bool eventFilter(QObject *watched, QEvent *event) override
        {
            if (event->type() == QEvent::Resize)
                setGeometry(parentWidget()->rect());
            return QWidget::eventFilter(watched, event);
        }

    private:
        QString m_sentence;
    };

    QString snrText(const PathEvidence &evidence)
    {
        return evidence.snr() > 0.0 ? HandLinePanel::tr("%1 dB").arg(numberText(dbFromRatio(evidence.snr()), 1))
                                    : HandLinePanel::tr("none");
    }

    std::vector<TableHeading> pathHeadings()
    {
        return {{HandLinePanel::tr("Path"), {}, Qt::AlignLeft},
                {HandLinePanel::tr("Frames")},
                {HandLinePanel::tr("Σ λ (nat)"),
                 HandLinePanel::tr("Evidence: the sum of the log-likelihood ratios along the path")},
                {HandLinePanel::tr("SNR"),
                 HandLinePanel::tr("Mean power along the path over the noise power, less one, in one frame")}};
    }

} // namespace

HandLinePanel::HandLinePanel(Document &document, const Pictures &pictures, QWidget *parent)
    : QWidget(parent), m_document(document), m_pictures(pictures), m_line(new HandLine(pictures.input)),
      m_draw(new QPushButton(tr("Dra&w"))), m_cover(new QPushButton(tr("Cover the &statistic"))),
      m_add(new QPushButton(tr("Point at c&ursor"))), m_remove(new QPushButton(tr("Remove las&t"))),
      m_clear(new QPushButton(tr("&Clear"))), m_sentence(panelSentence()),
      m_table(new ColumnTable(tr("Evidence along your line and along the detector's path"))),
      m_comparison(this, &HandLinePanel::question, compare, &HandLinePanel::show)
{
    m_draw->setCheckable(true);
    m_draw->setToolTip(
        tr("Click the input picture to add a point; drag a point to move it, right-click it to remove it"));
    m_cover->setCheckable(true);
    m_cover->setToolTip(tr("Hide statistic, tracks and truth until you reveal them"));
    m_add->setToolTip(tr("Add a point at the cursor, which the arrow keys move"));
    buildTable();

    auto *buttons = new QGridLayout;
    buttons->addWidget(m_draw, 0, 0);
    buttons->addWidget(m_cover, 0, 1);
    buttons->addWidget(m_add, 1, 0);
    buttons->addWidget(m_remove, 1, 1);
    buttons->addWidget(m_clear, 2, 0);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 6, 8, 6);
    layout->addLayout(buttons);
    layout->addWidget(m_table);
    layout->addWidget(m_sentence);
    layout->addStretch(1);

    connectInputs();
    showSentence();
}

void HandLinePanel::buildTable()
{
    m_table->show(pathHeadings());
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    m_table->setFocusPolicy(Qt::ClickFocus);
    m_table->setFixedHeight(m_table->horizontalHeader()->sizeHint().height() + 3 * 22 + 2);
}

void HandLinePanel::connectInputs()
{
    connect(m_draw, &QPushButton::toggled, this, [this](bool isOn) {
        m_line->setActive(isOn);
        showSentence();
    });
    connect(m_cover, &QPushButton::toggled, this, &HandLinePanel::setCovered);
    connect(m_clear, &QPushButton::clicked, m_line, &HandLine::clear);
    connect(m_remove, &QPushButton::clicked, m_line, &HandLine::removeLast);
    connect(m_add, &QPushButton::clicked, this, [this] {
        if (const auto &cursor = m_document.viewport().cursor())
            m_line->add(*cursor);
    });
    m_comparison.askAt(*m_line, &HandLine::changed);
    m_comparison.askAt(m_document, &Document::analysisChanged);
    connect(&m_document, &Document::opened, this, [this] {
        m_line->clear();
        m_cover->setChecked(false);
    });
}

HandLinePanel::Comparison HandLinePanel::compare(const std::shared_ptr<const Analysis> &shown,
                                                 const std::vector<PolylinePoint> &line, const RunContext &context)
{
    const Analysis &analysis = *shown;
    Comparison result;
    const std::vector<PathCell> own = cellsAlong(analysis, line);
    result.own = evidenceAlong(analysis, own, context);
    std::vector<PathCell> ownThere;
    std::vector<PathCell> detector;
    for (const Track &track : analysis.tracks) {
        std::vector<PathCell> mine;
        std::vector<PathCell> theirs;
        auto at = own.begin();
        for (const TrackPoint &point : track.points) {
            at = std::find_if(at, own.end(), [&](const PathCell &cell) { return cell.frame >= point.frame; });
            if (at != own.end() && at->frame == point.frame) {
                mine.push_back(*at);
                theirs.push_back({point.frame, point.cell});
            }
        }
        const auto apart = [](const std::vector<PathCell> &a, const std::vector<PathCell> &b) {
            double sum = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i)
                sum += std::abs(double(a[i].cell - b[i].cell));
            return a.empty() ? 0.0 : sum / double(a.size());
        };
        // Of parallel tracks the nearer one; a long track takes precedence over a fragment.
        const bool isBetter = mine.size() > 2 * ownThere.size()
                              || (2 * mine.size() > ownThere.size() && apart(mine, theirs) < apart(ownThere, detector));
        if (mine.empty() || !isBetter)
            continue;
        result.track = track.id;
        result.meanHz = apart(mine, theirs) * analysis.grid().axes.back().step;
        ownThere = std::move(mine);
        detector = std::move(theirs);
    }
    result.frames = std::ssize(detector);
    result.ownThere = evidenceAlong(analysis, ownThere, context);
    result.detector = evidenceAlong(analysis, detector, context);
    return result;
}

HandLinePanel::Asking::Question HandLinePanel::question() const
{
    std::vector<PolylinePoint> line;
    for (const Viewport::Point &point : m_line->points())
        line.push_back({point.seconds, point.hz});
    const auto analysis = m_document.lineAnalysis();
    return Asking::questionIf(analysis && !line.empty(), {}, analysis, line);
}

void HandLinePanel::show()
{
    showSentence();
    const Comparison *both = comparison();
    if (!both)
        return m_table->clear();
    std::vector<std::vector<TableCell>> rows;
    const auto add = [&](const QString &name, const PathEvidence &one, bool isShown) {
        rows.push_back({{name}, {}, {}, {}});
        if (isShown)
            rows.back() = {{name},
                           {QString::number(one.frames), double(one.frames)},
                           {numberText(one.logLikelihoodRatio, 1), one.logLikelihoodRatio},
                           {snrText(one), one.meanPower}};
    };
    const bool areShared = both->track && !isCovered();
    add(tr("Your line, all frames"), both->own, true);
    add(tr("Your line, shared frames"), both->ownThere, areShared);
    add(tr("Detector, shared frames"), both->detector, areShared);
    m_table->show(pathHeadings(), std::move(rows));
}

void HandLinePanel::showSentence()
{
    if (!comparison())
        return m_sentence->setText(m_document.frameKind().handLineHint);
    const Comparison &both = *comparison();
    if (isCovered())
        return m_sentence->setText(
            tr("Your line collects %1 nat in %2 frames. Press Reveal to compare it with the detector.")
                .arg(numberText(both.own.logLikelihoodRatio, 1))
                .arg(both.own.frames));
    if (!both.track)
        return m_sentence->setText(tr("The detector has no track in these frames."));
    const double ahead = both.ownThere.logLikelihoodRatio - both.detector.logLikelihoodRatio;
    m_sentence->setText(tr("In the %1 frames shared with track %2, your line is %3 nat %4 and on average %5 away. The "
                           "detector's statistic also contains ln P and ln K of every step.")
                            .arg(both.frames)
                            .arg(both.track)
                            .arg(numberText(std::abs(ahead), 1), ahead > 0.0 ? tr("ahead of it") : tr("behind it"),
                                 hertzText(both.meanHz, 0.1)));
}

void HandLinePanel::setCovered(bool isCovered)
{
    for (QWidget *&cover : m_covers) {
        delete cover;
        cover = nullptr;
    }
    for (const auto layer : {PictureDisplay::EventLayer, PictureDisplay::TrackLayer, PictureDisplay::TruthLayer})
        m_document.display().setLayer(layer, !isCovered);
    if (isCovered) {
        m_covers[0] = new Cover(m_pictures.statistic, tr("Where is the line? Draw it through the input, then reveal."));
        m_covers[1] = new Cover(m_pictures.statisticAlongTime, {});
        m_draw->setChecked(true);
    }
    m_cover->setChecked(isCovered);
    m_cover->setText(isCovered ? tr("Reveal the &statistic") : tr("Cover the &statistic"));
    show();
}

/// While hidden it neither takes clicks nor covers anything.
void HandLinePanel::hideEvent(QHideEvent *event)
{
    QWidget::hideEvent(event);
    if (window()->isVisible() && !event->spontaneous()) {
        m_draw->setChecked(false);
        m_cover->setChecked(false);
    }
}

} // namespace faintline
