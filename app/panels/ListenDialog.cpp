#include "app/panels/ListenDialog.h"

#include "app/base/filePath.h"
#include "base/Error.h"
#include "widgets/base/labelText.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
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

ListenDialog::ListenDialog(QWidget *parent)
    : QDialog(parent), m_kind(new QComboBox), m_forms(new QStackedWidget), m_folder(new QLineEdit),
      m_trouble(plainLabel())
{
    setWindowTitle(tr("Listen"));
    for (const ListenSourceKind &kind : listenSourceKinds()) {
        m_kind->addItem(kind.name);
        m_forms->addWidget(kind.makeForm());
    }
    m_kind->setObjectName(QStringLiteral("sourceKind"));
    connect(m_kind, &QComboBox::currentIndexChanged, m_forms, &QStackedWidget::setCurrentIndex);
    m_folder->setText(QDir(QStandardPaths::writableLocation(QStandardPaths::HomeLocation))
                          .filePath(QStringLiteral("Faintline recordings")));
    m_folder->setObjectName(QStringLiteral("folder"));
    m_folder->setToolTip(tr("All that is heard is recorded here, as SigMF; the folder is made where there is none"));
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
    m_trouble->setWordWrap(true);
    m_trouble->hide();
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    buttons->button(QDialogButtonBox::Ok)->setText(tr("&Listen"));
    connect(buttons, &QDialogButtonBox::accepted, this, &ListenDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

    auto *head = new QFormLayout;
    head->addRow(tr("&Source"), m_kind);
    auto *foot = new QFormLayout;
    auto *folderLabel = new QLabel(tr("Record &into"));
    folderLabel->setBuddy(m_folder);
    foot->addRow(folderLabel, folderRow);
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(head);
    layout->addWidget(m_forms);
    layout->addLayout(foot);
    layout->addWidget(m_trouble);
    layout->addWidget(buttons);
    setMinimumWidth(460);
}

QString ListenDialog::folder() const
{
    return m_folder->text().trimmed();
}

void ListenDialog::accept()
{
    try {
        if (folder().isEmpty())
            throw Error(tr("Record into").toStdString(), tr("is empty; give a folder").toStdString());
        if (!QDir().mkpath(folder()))
            throw Error(pathBytes(folder()), tr("is no folder that can be made").toStdString());
        m_source = static_cast<ListenSourceForm *>(m_forms->currentWidget())->source();
        QDialog::accept();
    } catch (const Error &error) {
        m_trouble->setText(messageText(error.what()));
        m_trouble->show();
    }
}

} // namespace faintline
