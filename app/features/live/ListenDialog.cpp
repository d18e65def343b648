#include "app/features/live/ListenDialog.h"

#include "app/base/filePath.h"
#include "base/Error.h"
#include "widgets/base/diskRoom.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>

namespace faintline {

namespace {

    constexpr int diskRefreshMs = 500;
    constexpr double megabyte = 1e6;
    constexpr double gigabyte = 1e9;
    constexpr double littleTime = 3600.0; ///< s of remaining disk time
    constexpr double littleSpace = 1e9;   ///< bytes, if the rate is not yet known

    /// `none`: text shown for 0.
    QDoubleSpinBox *limitBox(const QString &unit, double largest, const QString &none)
    {
        auto *box = new QDoubleSpinBox;
        box->setRange(0.0, largest);
        box->setDecimals(0);
        box->setSuffix(unit);
        box->setSpecialValueText(none);
        return box;
    }

} // namespace

ListenDialog::ListenDialog(QWidget *parent)
    : QDialog(parent), m_kind(new QComboBox), m_forms(new QStackedWidget), m_folder(new QLineEdit),
      m_largest(limitBox(tr(" MB"), 1e9, tr("no size limit"))),
      m_longest(limitBox(tr(" min"), 1e6, tr("no time limit"))), m_disk(plainLabel()), m_trouble(plainLabel())
{
    setWindowTitle(tr("Listen"));
    for (const ListenSourceKind &kind : listenSourceKinds()) {
        m_kind->addItem(kind.name);
        m_forms->addWidget(kind.makeForm());
    }
    m_kind->setObjectName(QStringLiteral("sourceKind"));
    connect(m_kind, &QComboBox::currentIndexChanged, m_forms, &QStackedWidget::setCurrentIndex);
    m_trouble->setWordWrap(true);
    m_trouble->hide();
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    buttons->button(QDialogButtonBox::Ok)->setText(tr("&Listen"));
    connect(buttons, &QDialogButtonBox::accepted, this, &ListenDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

    auto *head = new QFormLayout;
    head->addRow(tr("&Source"), m_kind);
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(head);
    layout->addWidget(m_forms);
    layout->addLayout(recordForm());
    layout->addWidget(m_trouble);
    layout->addWidget(buttons);
    setMinimumWidth(460);
    m_refresh.setInterval(diskRefreshMs);
    connect(&m_refresh, &QTimer::timeout, this, [this] {
        if (isVisible())
            showDisk();
    });
    m_refresh.start();
    showDisk();
}

QFormLayout *ListenDialog::recordForm()
{
    m_folder->setText(QDir(QStandardPaths::writableLocation(QStandardPaths::HomeLocation))
                          .filePath(QStringLiteral("Faintline recordings")));
    m_folder->setObjectName(QStringLiteral("folder"));
    m_folder->setToolTip(tr("Folder for the recording (SigMF); created if it does not exist"));
    auto *browse = new QToolButton;
    browse->setText(tr("Browse…"));
    connect(browse, &QToolButton::clicked, this, [this] {
        const QString path = pathOf(QFileDialog::getExistingDirectoryUrl(this, tr("Record into")));
        if (!path.isEmpty())
            m_folder->setText(path);
    });
    auto *folderRow = new QHBoxLayout;
    folderRow->addWidget(m_folder, 1);
    folderRow->addWidget(browse);
    auto *folderLabel = new QLabel(tr("Record &into"));
    folderLabel->setBuddy(m_folder);
    auto *limits = new QHBoxLayout;
    limits->addWidget(m_longest, 1);
    limits->addWidget(new QLabel(tr("or")));
    limits->addWidget(m_largest, 1);
    m_longest->setObjectName(QStringLiteral("longest"));
    m_largest->setObjectName(QStringLiteral("largest"));
    const QString tip = tr("Start a new file at this duration or size; a list (.timeline) opens all files as one");
    for (QWidget *box : {m_longest, m_largest})
        box->setToolTip(tip);
    auto *limitLabel = new QLabel(tr("&New file after"));
    limitLabel->setBuddy(m_longest);
    m_disk->setWordWrap(true);
    m_disk->setObjectName(QStringLiteral("disk"));
    auto *form = new QFormLayout;
    form->addRow(folderLabel, folderRow);
    form->addRow(limitLabel, limits);
    form->addRow(tr("Disk"), m_disk);
    return form;
}

const ListenSourceForm &ListenDialog::form() const
{
    return *static_cast<const ListenSourceForm *>(m_forms->currentWidget());
}

QString ListenDialog::folder() const
{
    return m_folder->text().trimmed();
}

RotationSettings ListenDialog::rotation() const
{
    return {m_largest->value() * megabyte, m_longest->value() * 60.0};
}

void ListenDialog::showDisk()
{
    const std::optional<double> room = freeBytes(folder());
    if (!room)
        return m_disk->setText(tr("unknown"));
    const std::optional<double> rate = form().bytesPerSecond();
    const bool isLittle = rate ? *room < littleTime * *rate : *room < littleSpace;
    const QString space = tr("%1 GB free").arg(numberText(*room / gigabyte, 1));
    const QString words = rate ? tr("%1, full in %2").arg(space, roughTimeText(*room / *rate)) : space;
    m_disk->setText(isLittle ? tr("Warning: only %1").arg(words) : words);
}

void ListenDialog::accept()
{
    try {
        if (folder().isEmpty())
            throw Error(tr("Record into").toStdString(), tr("is empty; give a folder").toStdString());
        if (!QDir().mkpath(folder()))
            throw Error(pathBytes(folder()), tr("cannot be created").toStdString());
        m_source = form().source();
        QDialog::accept();
    } catch (const Error &error) {
        m_trouble->setText(messageText(error.what()));
        m_trouble->show();
    }
}

} // namespace faintline
