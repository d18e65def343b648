#include "app/features/opening/WelcomePage.h"

#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/features/opening/Card.h"
#include "app/features/opening/scenarios.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

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

WelcomePage::WelcomePage(QWidget *lessons, QWidget *parent) : QWidget(parent), m_recent(new QVBoxLayout)
{
    auto *page = new QWidget;
    page->setMaximumWidth(pageWidth);
    auto *open = new QPushButton(tr("&Open recording…"));
    open->setFont(Theme::boldFont(14));
    open->setMinimumSize(180, 34);
    open->setToolTip(tr("WAV, FLAC and other audio, SigMF, raw I/Q, a scenario (.json), a session (.faintline)"));
    connect(open, &QPushButton::clicked, this, &WelcomePage::openRequested);

    auto *opening = new QHBoxLayout;
    opening->addWidget(sentence(tr("Faintline"), Theme::boldFont(28)), 1);
    opening->addWidget(open);
    m_recent->setSpacing(0);

    auto *column = new QVBoxLayout(page);
    column->setContentsMargins(24, 14, 24, 14);
    column->setSpacing(8);
    column->addLayout(opening);
    column->addWidget(
        sentence(tr("Finds signals too faint to see by adding up the evidence along every path a signal "
                    "could have taken. Above, what is recorded; below, what is found. Click a picture to open it."),
                 Theme::font(15)));
    column->addLayout(buildCards(exampleRecordings()));
    column->addLayout(buildCards(scenarios()));
    column->addWidget(lessons);
    column->addLayout(m_recent);
    column->addStretch(1);

    auto *centred = new QWidget;
    auto *centring = new QHBoxLayout(centred);
    centring->setContentsMargins(0, 0, 0, 0);
    centring->addStretch(1);
    centring->addWidget(page, 1000);
    centring->addStretch(1);
    setScrolledColumn(*this, centred, Qt::ScrollBarAsNeeded);
}

QLayout *WelcomePage::buildCards(const std::vector<Scenario> &shown)
{
    auto *cards = new QHBoxLayout;
    cards->setSpacing(16);
    for (const Scenario &scenario : shown) {
        if (scenario.picture.isEmpty())
            continue;
        auto *card = new Card(scenario);
        m_cards.push_back(card);
        cards->addWidget(card, 1);
        connect(card, &Card::clicked, this, [this, path = scenario.path] { emit pathChosen(path); });
    }
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

} // namespace faintline
