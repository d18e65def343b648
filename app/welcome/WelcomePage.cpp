#include "app/welcome/WelcomePage.h"

#include "analyse/analyse.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/welcome/ScanCard.h"
#include "app/welcome/ScenarioCard.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    constexpr int mostRecent = 5;
    constexpr int pageWidth = 1380;

    QLabel *sentence(const QString &text, const QFont &font)
    {
        auto *label = new QLabel(text);
        label->setFont(font);
        label->setWordWrap(true);
        return label;
    }

    /// Empties a layout of its widgets.
    void clear(QLayout &layout)
    {
        while (QLayoutItem *item = layout.takeAt(0)) {
            delete item->widget();
            delete item;
        }
    }

} // namespace

WelcomePage::WelcomePage(QWidget *lessons, QWidget *parent)
    : QWidget(parent), m_scanCard(new ScanCard), m_recent(new QVBoxLayout)
{
    connect(&m_runner, &JobRunner::failed, this, &WelcomePage::failed);
    auto *page = new QWidget;
    page->setMaximumWidth(pageWidth);
    auto *open = new QPushButton(tr("&Open recording…"));
    open->setFont(Theme::boldFont(14));
    open->setMinimumSize(180, 34);
    open->setToolTip(tr("WAV, FLAC and other audio, SigMF, raw I/Q, a scenario (.json), a session (.faintline)"));
    connect(open, &QPushButton::clicked, this, &WelcomePage::openRequested);

    auto *opening = new QHBoxLayout;
    opening->addWidget(open);
    opening->addSpacing(12);
    opening->addWidget(sentence(tr("or drop a file anywhere on this window"), Theme::font()), 1);
    m_recent->setSpacing(0);

    auto *column = new QVBoxLayout(page);
    column->setContentsMargins(24, 28, 24, 24);
    column->setSpacing(12);
    column->addWidget(sentence(tr("Faintline"), Theme::boldFont(28)));
    column->addWidget(
        sentence(tr("Finds signals too faint to see by adding up the evidence along every path a signal could have "
                    "taken. Click a picture to open it."),
                 Theme::font(15)));
    column->addSpacing(8);
    column->addLayout(buildCards());
    column->addSpacing(8);
    column->addLayout(opening);
    column->addWidget(lessons);
    column->addLayout(m_recent);
    column->addStretch(1);

    auto *centred = new QWidget;
    auto *centring = new QHBoxLayout(centred);
    centring->setContentsMargins(0, 0, 0, 0);
    centring->addStretch(1);
    centring->addWidget(page, 1000);
    centring->addStretch(1);
    auto *area = new QScrollArea;
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setWidget(centred);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(area);
}

QLayout *WelcomePage::buildCards()
{
    auto *cards = new QHBoxLayout;
    cards->setSpacing(16);
    for (const Scenario &scenario : scenarios()) {
        if (!scenario.isWelcome)
            continue;
        auto *card = new ScenarioCard(scenario);
        m_cards.push_back(card);
        cards->addWidget(card, 1);
        connect(card, &ScenarioCard::clicked, this, [this, card] { emit scenarioChosen(card); });
    }
    cards->addWidget(m_scanCard, 1);
    connect(m_scanCard, &ScanCard::clicked, this, &WelcomePage::scansChosen);
    return cards;
}

void WelcomePage::setRecent(const QStringList &paths)
{
    clear(*m_recent);
    if (paths.isEmpty())
        return;
    m_recent->addWidget(sentence(tr("Recent"), Theme::boldFont(14)));
    for (const QString &path : paths.mid(0, mostRecent)) {
        auto *button = new QPushButton(buttonText(distinctLabel(path, paths)));
        button->setFlat(true);
        button->setStyleSheet(QStringLiteral("text-align: left; padding: 3px 0px;"));
        button->setCursor(Qt::PointingHandCursor);
        button->setToolTip(asHtml(labelText(pathBytes(path), longestPath)));
        connect(button, &QPushButton::clicked, this, [this, path] { emit pathChosen(path); });
        m_recent->addWidget(button, 0, Qt::AlignLeft);
    }
}

void WelcomePage::start()
{
    if (!m_runner.isRunning())
        startNext();
}

void WelcomePage::stop()
{
    m_runner.cancel();
}

void WelcomePage::startNext()
{
    const auto next =
        std::find_if(m_cards.begin(), m_cards.end(), [](const ScenarioCard *card) { return !card->analysis(); });
    if (next == m_cards.end())
        return m_scanCard->hasResult() ? emit settled() : startScans();
    m_runner.start(
        [this, card = *next, path = (*next)->scenario().path](const RunContext &context) -> JobRunner::Delivery {
            const OpenedSource opened = openSource(sourceAt(path));
            const auto analysis = analyse(opened, firstSettings(opened), {}, context);
            return [this, card, opened, analysis] {
                card->setResult(opened, analysis);
                startNext();
            };
        });
}

void WelcomePage::startScans()
{
    m_runner.start([this](const RunContext &context) -> JobRunner::Delivery {
        return [this, result = ScanCard::compute(context)] {
            m_scanCard->setResult(result);
            emit settled();
        };
    });
}

} // namespace faintline
